// A station whose map is full: what it costs the station and those who watch, and how late they are.
// usage: node bench/map_load/load.mjs STATION [--part viewers,page,past] [--viewers 0,1,20] [--grid none,patch,whole] [--seconds 10]
// [--compression plain|deflate] [--json FILE]
//
// STATION is the program bench_map_station: `lapwing station` with a writer of grids. Slots, points, pictures, walls and areas come over
// HTTP, as does a stamp ten times a second, by which each viewer tells how late it is. Everything runs on this machine, the viewers in one
// process, the browser in its own; processor time is told of the station alone.
import { fork, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { COUNTS, fill, put, slot, stamped } from './content.mjs';
import { findProbe, launch, open, pause, rested, share, smoothness, writeToPainted } from './page.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    part: { type: 'string', default: 'viewers,page,past' },
    viewers: { type: 'string', default: '0,1,20' },
    grid: { type: 'string', default: 'none,patch,whole' },
    seconds: { type: 'string', default: '10' },
    compression: { type: 'string', default: 'plain' },
    json: { type: 'string' },
  },
});
const [program] = positionals;
const seconds = Number(values.seconds);
const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-map-load-'));
const rows = [];
const now = () => performance.timeOrigin + performance.now();

async function startStation() {
  const station = spawn(program, [path.join(folder, 'store'), 'udpin://127.0.0.1:0'], { stdio: ['pipe', 'ignore', 'pipe'] });
  let said = '';
  const address = new Promise((found, fail) => {
    station.stderr.on('data', (text) => {
      said += text;
      const [match] = /http:\/\/127\.0\.0\.1:\d+\//.exec(said) ?? [];
      if (match) found(match);
    });
    station.on('exit', () => fail(new Error(`the station ended: ${said}`)));
  });
  return { station, url: await address };
}

async function end({ station }) {
  const ended = new Promise((over) => station.on('exit', over));
  station.stdin.end();
  await ended;
}

function processorSeconds(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
  return (Number(fields[11]) + Number(fields[12])) / 100;
}

function residentMb(pid) {
  return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;
}

/** A stamp ten times a second, and twenty slots that somebody has looked at again. */
function keepWriting(url) {
  let [goes, number] = [true, 0];
  const late = [];
  const done = (async () => {
    for (let [next, count] = [now(), 0]; goes; next += 50 + 100 * Math.random(), ++count) {
      const sent = now();
      await put(url, 'points_of_interest', stamped(count, sent));
      late.push(now() - sent);
      for (let i = 0; i < 2; ++i, ++number) await put(url, 'slots', slot((number * 7) % COUNTS.slots, number % 2 ? 'taken' : 'free'));
      await pause(Math.max(0, next - now()));
    }
  })();
  return async () => {
    goes = false;
    await done;
    return late.sort((a, b) => a - b);
  };
}

/** What the station took of the processor, a share of a core, while `work` went on. */
async function costOf({ station }, work) {
  const [before, begun] = [processorSeconds(station.pid), now()];
  const result = await work();
  return { ...result, station_percent: ((processorSeconds(station.pid) - before) * 1e5) / (now() - begun), station_mb: residentMb(station.pid) };
}

function tell(row, text) {
  rows.push(row);
  console.log(`load    ${text}`);
}
const figure = (value, digits = 0) => (value === undefined ? '-' : value.toFixed(digits));
const ofStation = (row) => `station ${figure(row.station_percent, 1)} % of a core, ${figure(row.station_mb)} MB`;

async function viewersPart(station, grid, count) {
  const viewers = fork(fileURLToPath(new URL('viewers.mjs', import.meta.url)), [station.url, String(count), values.compression]);
  const report = () => new Promise((told) => (viewers.once('message', told), viewers.send({})));
  const stop = keepWriting(station.url);
  station.station.stdin.write(`${grid}\n`);
  await pause(3000);
  await report();
  const row = await costOf(station, async () => {
    const begun = now();
    await pause(seconds * 1000);
    const { late_ms, ...sums } = await report();
    const each = (bytes) => bytes / Math.max(count, 1) / ((now() - begun) / 1000) / 1000;
    late_ms.sort((a, b) => a - b);
    return { wire_kb_s: each(sums.wire_bytes), text_kb_s: each(sums.text_bytes), pictures_kb_s: each(sums.picture_bytes), stamps: late_ms.length, p50_ms: share(late_ms, 0.5), p99_ms: share(late_ms, 0.99) };
  });
  const asked = await stop();
  viewers.disconnect();
  tell(
    { part: 'viewers', grid, viewers: count, compression: values.compression, ...row, request_p99_ms: share(asked, 0.99) },
    `grid ${grid.padEnd(5)}, ${String(count).padStart(2)} viewers: ${ofStation(row)}; a viewer ${figure(row.wire_kb_s)} kB/s on the wire of ${figure(row.text_kb_s)} kB/s, pictures ${figure(row.pictures_kb_s)} kB/s; ` +
      `write to viewer p50 ${figure(row.p50_ms)} ms, p99 ${figure(row.p99_ms)} ms (${row.stamps}); request p99 ${figure(share(asked, 0.99), 1)} ms`,
  );
  await pause(500);
}

async function pagePart(station, browser) {
  const opened = await open(browser, station.url);
  const first_ms = await rested(opened.page);
  tell({ part: 'first', first_ms }, `a page at it is painted ${figure(first_ms)} ms after it was asked for`);
  for (let i = 0; i < 2; ++i) {
    await opened.page.keyboard.press('-');
    await rested(opened.page);
  }
  const at = await findProbe(opened.page, station.url);
  for (const grid of values.grid.split(',')) {
    station.station.stdin.write(`${grid}\n`);
    const stop = keepWriting(station.url);
    await pause(2500);
    const row = await costOf(station, () => smoothness(opened, seconds));
    const took = at ? await writeToPainted(opened.page, station.url, at, 40) : [];
    await stop();
    const latency = { painted_p50_ms: share(took, 0.5), painted_p99_ms: took.at(-1) };
    tell(
      { part: 'page', grid, ...row, ...latency },
      `grid ${grid.padEnd(5)}, page: ${figure(row.frames_a_second, 1)} frames/s, ${figure(row.map_frames_a_second, 1)} of the map, longest ${figure(row.longest_frame_ms)} ms, main thread ${figure(row.main_thread_percent)} %, ` +
        `${figure(row.drawing_ms_a_picture)} ms of drawing for a picture, page ${figure(row.page_mb)} MB of which heap ${figure(row.heap_mb, 1)} MB; write to painted p50 ${figure(latency.painted_p50_ms)} ms, p99 ${figure(latency.painted_p99_ms)} ms; ${ofStation(row)}`,
    );
  }
  if (process.env.SHOT) await opened.page.screenshot({ path: process.env.SHOT });
  station.station.stdin.write('none\n');
  await opened.page.close();
}

/** When the end of a session was asked for, and when all that lay on the map then was painted. */
async function seekEnd(page) {
  const sought = await page.evaluate(() => ((window.full_ = undefined), performance.now()));
  await page.keyboard.press('End');
  return [sought, await (await page.waitForFunction(() => window.full_, undefined, { polling: 50, timeout: 20_000 })).jsonValue()];
}

/** The station is started anew on what it has kept, and somebody looks back at the session before. */
async function pastPart(station, browser) {
  const times = [];
  for (let i = 0; i < 5; ++i) {
    const { page } = await open(browser, station.url);
    await rested(page);
    const began = await page.evaluate(() => {
      window.drawn_ = 0;
      document.querySelector('[aria-label="Look back"]').click();
      return performance.now();
    });
    const newest = await page.locator('[aria-label="Looking back"] select').last();
    await page.waitForFunction((list) => list.options.length > 1, await newest.elementHandle());
    const asked = await page.evaluate(() => {
      const list = [...document.querySelectorAll('[aria-label="Looking back"] select')].at(-1);
      list.value = list.options[1].value;
      list.dispatchEvent(new Event('change', { bubbles: true }));
      return performance.now();
    });
    // It begins with what there was when it began: nothing. At its end everything was there.
    await page.waitForFunction(() => document.querySelector('[aria-label="Looking back"] input[type=range]:enabled'));
    await rested(page);
    await page.locator('[aria-label="Looking back"] input[type=range]').focus();
    const [sought, full] = await seekEnd(page);
    times.push({ opened_ms: asked - began, painted_ms: full - sought });
    if (process.env.SHOT && i === 4) await page.screenshot({ path: process.env.SHOT.replace('.png', '-past.png') });
    await page.close();
  }
  const painted = times.map(({ painted_ms }) => painted_ms).sort((a, b) => a - b);
  tell({ part: 'past', times }, `the end of a stored session is painted ${figure(painted[2])} ms after it was asked for in the middle of 5, ${figure(painted[4])} ms at most`);
}

let station = await startStation();
try {
  const parts = values.part.split(',');
  const begun = now();
  await fill(station.url);
  console.log(`load    ${Object.values(COUNTS).reduce((a, b) => a + b)} features and ${COUNTS.pictures} pictures put on the map over HTTP in ${figure((now() - begun) / 1000, 1)} s`);
  if (parts.includes('viewers'))
    for (const grid of values.grid.split(',')) for (const count of values.viewers.split(',').map(Number)) await viewersPart(station, grid, count);
  const browser = parts.some((part) => part !== 'viewers') ? await launch() : undefined;
  try {
    if (parts.includes('page')) await pagePart(station, browser);
    if (parts.includes('past')) {
      if (!parts.includes('page')) {
        const stop = keepWriting(station.url); // something to look back at
        await pause(8000);
        await stop();
      }
      await end(station);
      station = await startStation();
      await pastPart(station, browser);
    }
  } finally {
    await browser?.close();
  }
} finally {
  await end(station);
  rmSync(folder, { recursive: true });
}
if (values.json) writeFileSync(values.json, JSON.stringify(rows));
