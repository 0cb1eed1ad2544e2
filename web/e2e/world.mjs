// The program itself with a copter, base maps of each kind, and a map on which something lies: a car park, and an office of two floors.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { startFleet } from './harness.mjs';
import { picture, plainPicture, serveTiles, vectorTile, writeMbtiles, writePmtiles } from './tiles.mjs';

export const ANCHOR = { lat_deg: 47.3977, lon_deg: 8.5456, alt_m: 488 };
const METRES_PER_DEGREE = 111_319.49;
const EAST = METRES_PER_DEGREE * Math.cos((ANCHOR.lat_deg * Math.PI) / 180);
const at = ([x, y]) => [ANCHOR.lon_deg + x / EAST, ANCHOR.lat_deg + y / METRES_PER_DEGREE];
const ring = (...corners) => [[...corners, corners[0]].map(at)];

/** Colours of the grounds, by the names of the base maps. */
export const GROUNDS = { Archive: [40, 120, 60], 'One file': [150, 90, 30], 'Over the network': [60, 60, 150] };

/** A plan of rooms, dark lines on white. */
export function planPicture(width = 400, height = 240) {
  const lines = Buffer.alloc(height * (1 + 3 * width), 255);
  for (let y = 0; y < height; y += 1) {
    lines[y * (1 + 3 * width)] = 0;
    for (let x = 0; x < width; x += 1) {
      const isWall = x < 6 || x > width - 7 || y < 6 || y > height - 7 || (Math.abs(y - 140) < 3 && x < 360) || (y < 140 && x % 80 < 4);
      if (isWall) lines.fill(50, y * (1 + 3 * width) + 1 + 3 * x, y * (1 + 3 * width) + 4 + 3 * x);
    }
  }
  return picture(lines, width, height);
}

const DRAWN = {
  type: 'FeatureCollection',
  features: [
    {
      type: 'Feature',
      properties: { kind: 'lawn' },
      geometry: { type: 'Polygon', coordinates: ring([-900, -900], [900, -900], [900, 900], [-900, 900]) },
    },
  ],
};

async function ask(url, method, address, body, type = 'application/json') {
  const answer = await fetch(`${url}api/v1/${address}`, { method, headers: { 'Content-Type': type }, body });
  if (!answer.ok) throw new Error(`${method} ${address}: ${answer.status} ${await answer.text()}`);
  return answer.status === 204 ? undefined : answer.json();
}

/** Puts features on the map, each `[id, geometry, properties]`. */
export async function putFeatures(url, layer, features) {
  const collection = {
    type: 'FeatureCollection',
    features: features.map(([id, geometry, properties]) => ({
      type: 'Feature',
      id,
      geometry,
      properties: { site: 'demo', ...properties },
    })),
  };
  await ask(url, 'POST', `layers/${layer}/features?writer=surveyor`, JSON.stringify(collection));
}

export const point = (x, y) => ({ type: 'Point', coordinates: at([x, y]) });
export const square = (x, y, width, height) => ({
  type: 'Polygon',
  coordinates: ring([x, y], [x + width, y], [x + width, y + height], [x, y + height]),
});
const line = (...points) => ({ type: 'LineString', coordinates: points.map(at) });

export async function fill(url) {
  const floors = [
    { id: '0', name: 'Ground floor', up_m: 0 },
    { id: '1', name: 'First floor', up_m: 3.5 },
  ];
  await ask(url, 'PUT', 'sites/demo', JSON.stringify({ anchor: ANCHOR, floors }));
  const { sha256: tag } = await ask(url, 'POST', 'blobs', plainPicture([200, 60, 60], 240, 120), 'image/png');
  await putFeatures(url, 'walls', [
    ['outer', line([-30, 0], [-10, 0], [-10, 12], [-30, 12], [-30, 0]), { floor: '1', thickness_m: 0.3 }],
    ['corridor', line([-30, 7], [-12, 7]), { floor: '1' }],
  ]);
  await putFeatures(
    url,
    'points_of_interest',
    [221, 222, 223].map((room, index) => [
      `door ${room}`,
      point(-28 + 6 * index, 7),
      { floor: '1', kind: 'door', name: String(room), text: `Dr Lark\nRoom ${room}`, picture: tag, confidence: 0.9 },
    ]),
  );
  const slots = Array.from({ length: 40 }, (_, index) => [
    `P${index}`,
    square(20 + 2.5 * (index % 10), -30 + 8 * Math.floor(index / 10), 2.5, 5),
    { state: index % 3 ? 'free' : 'taken', taken_probability: index % 3 ? 0.05 : 0.94, name: String(100 + index) },
  ]);
  await putFeatures(url, 'slots', slots);
}

/** `url`, and `stop()`. */
export async function startWorld() {
  const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-world-'));
  const tiles = await serveTiles(plainPicture(GROUNDS['Over the network']));
  writeMbtiles(path.join(folder, 'archive.mbtiles'), plainPicture(GROUNDS.Archive), 'the tile makers');
  writePmtiles(path.join(folder, 'one.pmtiles'), plainPicture(GROUNDS['One file']), 2, { name: 'One file' });
  writePmtiles(path.join(folder, 'lines.pmtiles'), vectorTile('water'), 1, { name: 'Lines', vector_layers: [{ id: 'water' }] });
  writeFileSync(path.join(folder, 'yard.geojson'), JSON.stringify(DRAWN));
  const bases = [['file = "yard.geojson"', 'Yard'], ['file = "archive.mbtiles"', 'Archive'], ['file = "one.pmtiles"', 'One file'], ['file = "lines.pmtiles"', 'Lines'], [`tiles = "${tiles.address}"`, 'Over the network']]; // prettier-ignore
  const config = bases.map(([where, name]) => `[[map.base]]\n${where}\nname = "${name}"\n`).join('\n');
  writeFileSync(path.join(folder, 'station.toml'), config);
  const fleet = await startFleet('copter:1', 5, ['--config', path.join(folder, 'station.toml'), '--store', path.join(folder, 'store')]);
  await fill(fleet.url);
  return {
    url: fleet.url,
    stop: async () => {
      await fleet.stop();
      tiles.stop();
      rmSync(folder, { recursive: true, force: true });
    },
  };
}
