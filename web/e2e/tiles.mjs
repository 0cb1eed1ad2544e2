// Map tiles for tests, made here: pictures of one colour, archives that hold one of them for the whole world, and a server of them.
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { crc32, deflateSync } from './png.mjs';

/** A PNG of one colour, `[red, green, blue]`. */
export function plainPicture([red, green, blue], width = 256, height = width) {
  const row = Buffer.alloc(1 + 3 * width);
  for (let x = 0; x < width; x += 1) row.set([red, green, blue], 1 + 3 * x);
  return picture(Buffer.concat(Array(height).fill(row)), width, height);
}

/** A PNG of lines that begin with a zero byte and have three bytes a pixel. */
export function picture(lines, width, height) {
  const part = (name, content) => {
    const body = Buffer.concat([Buffer.from(name, 'latin1'), content]);
    const frame = Buffer.alloc(8);
    frame.writeUInt32BE(content.length);
    frame.writeUInt32BE(crc32(body), 4);
    return Buffer.concat([frame.subarray(0, 4), body, frame.subarray(4)]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width);
  head.writeUInt32BE(height, 4);
  head.set([8, 2], 8);
  const begin = Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]);
  return Buffer.concat([begin, part('IHDR', head), part('IDAT', deflateSync(lines)), part('IEND', Buffer.alloc(0))]);
}

/** MBTiles, whose tile at zoom 0 is that picture. */
export function writeMbtiles(file, tile, attribution) {
  const script = `
import sqlite3, sys
store = sqlite3.connect(sys.argv[1])
store.execute("CREATE TABLE metadata (name text, value text)")
store.execute("CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob)")
store.executemany("INSERT INTO metadata VALUES (?, ?)", [("name", "Archive"), ("format", "png"), ("minzoom", "0"), ("maxzoom", "0"), ("attribution", sys.argv[2])])
store.execute("INSERT INTO tiles VALUES (0, 0, 0, ?)", (sys.stdin.buffer.read(),))
store.commit()`;
  const done = spawnSync('python3', ['-c', script, file, attribution], { input: tile });
  if (done.status !== 0) throw new Error(String(done.stderr));
}

/** PMTiles 3 with one tile, at zoom 0; `type` 1: vector, 2: PNG. */
export function writePmtiles(file, tile, type, metadata) {
  const words = Buffer.from(JSON.stringify(metadata));
  const directory = Buffer.concat([1, 0, 1, tile.length, 1].map(varint));
  const header = Buffer.alloc(127);
  header.write('PMTiles', 'latin1');
  header[7] = 3;
  let at = 127;
  for (const [index, part] of [directory, words, Buffer.alloc(0), tile].entries()) {
    header.writeBigUInt64LE(BigInt(at), 8 + 16 * index);
    header.writeBigUInt64LE(BigInt(part.length), 16 + 16 * index);
    at += part.length;
  }
  for (const place of [72, 80, 88]) header.writeBigUInt64LE(1n, place);
  header.set([1, 1, 1, type, 0, 0], 96);
  for (const [index, degrees] of [-180, -85, 180, 85].entries()) header.writeInt32LE(degrees * 1e7, 102 + 4 * index);
  writeFileSync(file, Buffer.concat([header, directory, words, tile]));
}

function varint(number) {
  const bytes = [];
  for (; number > 127; number = Math.floor(number / 128)) bytes.push((number % 128) | 128);
  return Buffer.from([...bytes, number]);
}

/** A vector tile whose layer `name` is a polygon over all of it. */
export function vectorTile(name) {
  const field = (number, content) => Buffer.concat([varint(number * 8 + 2), varint(content.length), content]);
  const value = (number, one) => Buffer.concat([varint(number * 8), varint(one)]);
  const zigzag = (one) => (one < 0 ? -2 * one - 1 : 2 * one);
  const moves = [9, zigzag(0), zigzag(0), 26, zigzag(4096), 0, 0, zigzag(4096), zigzag(-4096), 0, 15];
  const feature = Buffer.concat([value(3, 3), field(4, Buffer.concat(moves.map(varint)))]);
  return field(3, Buffer.concat([field(1, Buffer.from(name)), field(2, feature), value(5, 4096), value(15, 2)]));
}

/** Serves that picture for every address, to pages of anywhere. */
export async function serveTiles(tile) {
  const server = createServer((_, answer) => {
    answer.writeHead(200, { 'Content-Type': 'image/png', 'Access-Control-Allow-Origin': '*' });
    answer.end(tile);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}/{z}/{x}/{y}.png`, stop: () => server.close() };
}
