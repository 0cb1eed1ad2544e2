// What lies on the map of the bench, put there as programs of users do it: over HTTP.
import { createHash, randomBytes } from 'node:crypto';
import { deflateSync } from 'node:zlib';

export const ANCHOR = { lat_deg: 47.4, lon_deg: 8.5 };
export const COUNTS = { slots: 2000, points_of_interest: 500, pictures: 1000, walls: 200, areas: 10 };
const TAKEN_AT = new Date(Date.now() - 3.6e6).toISOString();
const METRES_PER_DEGREE = { lat: 111_170, lon: 75_500 };

export const place = (east_m, north_m) => [ANCHOR.lon_deg + east_m / METRES_PER_DEGREE.lon, ANCHOR.lat_deg + north_m / METRES_PER_DEGREE.lat];

const box = (east, north, width, height) => [[[0, 0], [width, 0], [width, height], [0, height], [0, 0]].map(([x, y]) => place(east + x, north + y))];

const feature = (id, type, coordinates, properties = {}) => ({ type: 'Feature', id, geometry: { type, coordinates }, properties });

export function slot(number, state = number % 3 ? 'taken' : 'free') {
  const [row, column] = [Math.floor(number / 64), number % 64];
  return feature(`slot ${number}`, 'Polygon', box(column * 3 - 96, row * 6 - 96, 2.5, 5), { state, taken_probability: 0.9, seen_by: 'drone 1', name: String(number) });
}

/** Beside all else, so that nothing but itself changes how it looks: its state tells the page when it was written. */
export const probeSlot = (state) => feature('probe', 'Polygon', box(125, -8, 16, 16), { state });

/** Its text says when it was written. There are some, so that none is written over before it has been sent. */
export const stamped = (number, sent_ms) => feature(`stamp ${number % 20}`, 'Point', place(-120, number % 20), { kind: 'stamp', text: `sent ${sent_ms.toFixed(3)};` });

const spiral = (number, reach) => {
  const [angle, radius] = [number * 2.4, reach * Math.sqrt(number / 1000)];
  return [radius * Math.cos(angle), radius * Math.sin(angle)];
};

function features(layer, hashes) {
  const many = (make) => Array.from({ length: COUNTS[layer] }, (_, i) => make(i));
  switch (layer) {
    case 'slots':
      return many((i) => slot(i));
    case 'points_of_interest':
      return many((i) => feature(`door ${i}`, 'Point', place(...spiral(i * 2, 95)), { kind: 'door', name: `Room ${i}`, text: `Name tag of room ${i}`, picture: hashes[i] }));
    case 'pictures':
      return many((i) => {
        const [east, north] = spiral(i, 90);
        const corners = box(east, north, 12, 9).map((ring) => [ring[3], ring[2], ring[1], ring[0], ring[3]]);
        return feature(`picture ${i}`, 'Polygon', corners, { image: hashes[i], media_type: 'image/png', width_px: 64, height_px: 64, taken_at: TAKEN_AT, vehicle: 'drone 1' });
      });
    case 'walls':
      return many((i) => feature(`wall ${i}`, 'LineString', [place((i % 20) * 10 - 100, Math.floor(i / 20) * 20 - 100), place((i % 20) * 10 - 91, Math.floor(i / 20) * 20 - 100)], { thickness_m: 0.2 }));
    default:
      return many((i) => feature(`area ${i}`, 'Polygon', box(i * 20 - 100, -118, 15, 12), { purpose: 'wanted', name: `Area ${i}` }));
  }
}

export async function ask(url, method, path, body, type = 'application/geo+json') {
  const answer = await fetch(new URL(path, url), { method, body: body && !Buffer.isBuffer(body) ? JSON.stringify(body) : body, headers: body ? { 'Content-Type': type } : {} });
  if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
  return answer.json();
}

export const put = (url, layer, one) => ask(url, 'PUT', `/api/v1/layers/${layer}/features/${encodeURIComponent(one.id)}?site=default&writer=bench`, one);
export const post = (url, layer, all) => ask(url, 'POST', `/api/v1/layers/${layer}/features?site=default&writer=bench`, { type: 'FeatureCollection', features: all });

/** As PNG checks its parts; Node has it of its own from version 22 on. */
function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** A small picture of noise, no two the same. */
function png() {
  const [width, height] = [64, 64];
  const rows = Buffer.concat(Array.from({ length: height }, () => Buffer.concat([Buffer.from([0]), randomBytes(width)])));
  const chunk = (name, data) => {
    const text = Buffer.concat([Buffer.from(name), data]);
    const [length, check] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(data.length);
    check.writeUInt32BE(crc32(text));
    return Buffer.concat([length, text, check]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = 8; // grey, 8 bits
  return Buffer.concat([Buffer.from('89504e470d0a1a0a', 'hex'), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

export async function fill(url) {
  const pictures = Array.from({ length: COUNTS.pictures }, png);
  for (let i = 0; i < pictures.length; i += 20) await Promise.all(pictures.slice(i, i + 20).map((picture) => ask(url, 'POST', '/api/v1/blobs', picture, 'image/png')));
  const hashes = pictures.map((picture) => createHash('sha256').update(picture).digest('hex'));
  for (const layer of Object.keys(COUNTS)) {
    const all = features(layer, hashes);
    for (let i = 0; i < all.length; i += 500) await post(url, layer, all.slice(i, i + 500));
  }
  await put(url, 'slots', probeSlot('free'));
}
