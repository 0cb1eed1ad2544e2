// Viewers of a station in a process of their own: they hear every feed, fetch the pictures of a grid that are new to them as pages do, and
// count. usage: node viewers.mjs URL COUNT deflate|plain; answers each message of its parent with what came since the last.
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const fromWeb = createRequire(path.join(path.dirname(fileURLToPath(import.meta.url)), '../../web/package.json'));
const { WebSocket } = fromWeb('ws');

const [url, count, compression] = process.argv.slice(2);
const now = () => performance.timeOrigin + performance.now();
const VIEW = { west: 8.49841, east: 8.50159, south: 47.39933, north: 47.40067, zoom: 19 }; // 240 m by 150 m
let messages = 0;
let text_bytes = 0;
let picture_bytes = 0;
let late_ms = [];
const viewers = [];

function column(lon) {
  return Math.floor(((lon + 180) / 360) * 2 ** VIEW.zoom);
}
function row(lat) {
  return Math.floor((0.5 - Math.log(Math.tan(Math.PI / 4 + (lat * Math.PI) / 360)) / (2 * Math.PI)) * 2 ** VIEW.zoom);
}

/** The pictures of what has changed in view. */
function* changedIn({ tiling: { origin, x, y }, changed }) {
  const seen = new Set();
  for (const [i, j] of changed) {
    const [west, south] = [origin[0] + i * x[0], origin[1] + j * y[1]];
    const [from, to] = [Math.max(west, VIEW.west), Math.min(west + x[0], VIEW.east)];
    const [low, high] = [Math.max(south, VIEW.south), Math.min(south + y[1], VIEW.north)];
    if (from >= to || low >= high) continue;
    for (let c = column(from); c <= column(to); ++c) for (let r = row(high); r <= row(low); ++r) seen.add(`${c}/${r}`);
  }
  yield* seen;
}

async function fetchPictures(viewer, grid) {
  if (viewer.fetches || !grid.changed?.length) return;
  viewer.fetches = true;
  const wanted = [...changedIn(grid)];
  await Promise.all(
    wanted.map(async (tile) => {
      const address = grid.pictures.replace('{z}/{x}/{y}', `${VIEW.zoom}/${tile}`);
      const answer = await fetch(new URL(address, url));
      picture_bytes += (await answer.arrayBuffer()).byteLength;
    }),
  );
  viewer.fetches = false;
}

function take(viewer, text) {
  messages += 1;
  text_bytes += text.length;
  for (const [, sent] of text.matchAll(/sent ([0-9.]+);/g)) if (viewer.begun) late_ms.push(now() - Number(sent));
  if (text.includes('"type":"grids"')) for (const grid of JSON.parse(text).grids) fetchPictures(viewer, grid).catch(() => undefined);
}

function received() {
  return viewers.reduce((sum, { socket }) => sum + (socket._socket?.bytesRead ?? 0), 0);
}

for (let i = 0; i < Number(count); ++i) {
  const socket = new WebSocket(new URL('/api/v1/ws', url.replace('http', 'ws')), { perMessageDeflate: compression === 'deflate' });
  const viewer = { socket, begun: false, fetches: false };
  viewers.push(viewer);
  socket.on('message', (data) => {
    const text = String(data);
    if (text.includes('"type":"hello"')) {
      const feeds = JSON.parse(text).feeds.map(({ name }) => name);
      socket.send(JSON.stringify({ type: 'subscribe', id: '1', feeds }));
      setTimeout(() => (viewer.begun = true), 1000);
    }
    take(viewer, text);
  });
}
let received_before = 0;
process.on('message', () => {
  process.send({ messages, text_bytes, picture_bytes, wire_bytes: received() - received_before, late_ms });
  [messages, text_bytes, picture_bytes, late_ms, received_before] = [0, 0, 0, [], received()];
});
process.on('disconnect', () => process.exit());
