/** West, south, east, north, in degrees. */
export type LonLatBox = [number, number, number, number];

export interface TileId {
  z: number;
  x: number;
  y: number;
}

/** More are not asked for at once: who sees so much of it sees no single one. */
const MOST = 400;

/** The tiles of web Mercator at these zooms that both boxes touch. */
export function tilesWithin(box: LonLatBox, view: LonLatBox, zooms: readonly number[]): TileId[] {
  const [west, south, east, north] = [
    Math.max(box[0], view[0]),
    Math.max(box[1], view[1]),
    Math.min(box[2], view[2]),
    Math.min(box[3], view[3]),
  ];
  if (west > east || south > north) return [];
  const tiles: TileId[] = [];
  for (const z of zooms) {
    for (let x = column(west, z); x <= column(east, z); x += 1) {
      for (let y = row(north, z); y <= row(south, z); y += 1) {
        if (tiles.push({ z, x, y }) >= MOST) return tiles;
      }
    }
  }
  return tiles;
}

const inRange = (value: number, zoom: number): number => Math.min(Math.max(Math.floor(value), 0), 2 ** zoom - 1);
const column = (lon: number, zoom: number): number => inRange(((lon + 180) / 360) * 2 ** zoom, zoom);

function row(lat: number, zoom: number): number {
  const sine = Math.sin((lat * Math.PI) / 180);
  return inRange((0.5 - Math.log((1 + sine) / (1 - sine)) / (4 * Math.PI)) * 2 ** zoom, zoom);
}
