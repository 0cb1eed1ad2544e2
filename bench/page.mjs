// What the browser app costs in the browser that shows it. usage: node bench/page.mjs [--vehicles 3,100] [--points 1500] [--seconds 20]
// [--dist web/dist] [--pixels 1] [--json FILE]
//
// A made-up station serves the built app and sends it what a real one would, five times a second, of vehicles that fly in circles with
// trails of that many points. Told are, over those seconds: processor time of the page's main thread a tick (and what of it was script,
// style and layout), of the page's process with its workers and of the process that draws, which while the map is dragged is told for
// each picture of it, too; frames a second, those in which the map was drawn, and the longest frame: with vehicles that rest, that fly,
// and that fly while somebody drags the map about all the time. Drawing is done by the processor here, as on a machine without a GPU:
// figures of one machine compare with each other alone. With `--pixels 0.25` the map has a sixteenth of the pixels, so that frames tell of
// the page rather than of the drawing.
import { createReadStream, existsSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const fromWeb = createRequire(path.join(root, 'web/package.json'));
const { chromium } = fromWeb('playwright-core');
const { WebSocketServer } = fromWeb('ws');

const { values } = parseArgs({
  options: {
    vehicles: { type: 'string', default: '3,100' },
    points: { type: 'string', default: '1500' },
    seconds: { type: 'string', default: '20' },
    pixels: { type: 'string', default: '1' },
    dist: { type: 'string', default: path.join(root, 'web/dist') },
    json: { type: 'string' },
  },
});

const TICK_MS = 200;
/** Flown in one tick: further than two points of a trail are apart, so that each tick is a point of it. */
const STEP_M = 1.6;
const METRES_PER_DEGREE = 111_320;
const HOME = { lat_deg: 47.3977, lon_deg: 8.5456, alt_m: 488 };
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

/** A station as far as the page can tell; `tick` moves every vehicle by a step, or lets them all stand still. */
async function startStation(count) {
  const files = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://station');
    const file = path.join(values.dist, pathname === '/' ? 'index.html' : path.normalize(pathname));
    if (!pathname.startsWith('/api/') && existsSync(file)) {
      response.writeHead(200, { 'Content-Type': TYPES[path.extname(file)] ?? 'application/octet-stream' });
      createReadStream(file).pipe(response);
    } else response.writeHead(pathname.startsWith('/api/') ? 200 : 404, { 'Content-Type': 'application/json' }).end('{"scripts":[]}');
  });
  const sockets = new WebSocketServer({ server: files });
  await new Promise((listening) => files.listen(0, '127.0.0.1', listening));
  const begun = performance.now();
  let moved = 0;

  const message = (full) =>
    JSON.stringify({ type: 'vehicles', time_s: (performance.now() - begun) / 1000, full, vehicles: Array.from({ length: count }, (_, i) => vehicle(i, moved, full)) });
  sockets.on('connection', (socket) => {
    socket.send(JSON.stringify({ type: 'hello', protocol: 1, version: 'bench', operator: 'operator 1', server_time: new Date().toISOString(), site: { name: 'bench', origin: HOME } }));
    socket.send(message(true));
    socket.on('message', (text) => {
      const { type, id } = JSON.parse(text);
      if (type === 'ping') socket.send(JSON.stringify({ type: 'pong', id, server_time: new Date().toISOString() }));
    });
  });
  return {
    url: `http://127.0.0.1:${files.address().port}/`,
    tick: (moves = true) => {
      moved += moves ? 1 : 0;
      for (const socket of sockets.clients) socket.send(message(false));
    },
    stop: () => {
      for (const socket of sockets.clients) socket.terminate();
      files.close();
    },
  };
}

/** Vehicles have circles of their own, side by side, so that trails neither lie on each other nor leave the sight. */
function vehicle(index, moved, full) {
  const radius_m = 40 + (index % 7) * 9;
  const angle = (moved * STEP_M) / radius_m + index;
  const [row, column] = [Math.floor(index / 10), index % 10];
  const north = row * 90 + radius_m * Math.cos(angle);
  const east = column * 90 + radius_m * Math.sin(angle);
  const position = {
    lat_deg: HOME.lat_deg + north / METRES_PER_DEGREE,
    lon_deg: HOME.lon_deg + east / (METRES_PER_DEGREE * Math.cos((HOME.lat_deg * Math.PI) / 180)),
    alt_m: 510 + index,
  };
  const speed = (STEP_M * 1000) / TICK_MS;
  const age_s = { heartbeat: 0.3, position: 0.05, battery: 0.4, mode: 0.3 };
  const news = {
    id: String(index + 1),
    position,
    relative_alt_m: 20 + index / 10,
    velocity_m_s: { north: -speed * Math.sin(angle), east: speed * Math.cos(angle), down: 0 },
    heading_rad: (angle + Math.PI / 2) % (2 * Math.PI),
    battery: { remaining: 0.8 - (moved % 1000) / 1e5, voltage_v: 15.1, current_a: 12.4 },
    age_s,
  };
  if (!full) return news;
  const known = { system_id: index + 1, name: `copter ${index + 1}`, family: 'copter', autopilot: 'ardupilot', connection: 'ok', mode: 'AUTO', armed: true, landed: false, home: HOME };
  return { ...news, ...known, health: { position_ok: true, prearm_ok: true }, mission: { current: 3, total: 9, complete: false } };
}

/** Processor time in s of each of the browser's processes, by kind. */
async function processTimes(system) {
  const { processInfo } = await system.send('SystemInfo.getProcessInfo');
  const times = {};
  for (const { type, cpuTime } of processInfo) times[type] = (times[type] ?? 0) + cpuTime;
  return times;
}

async function mainThread(session) {
  const { metrics } = await session.send('Performance.getMetrics');
  return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
}

async function overSomeTime(page, session, system, tick) {
  const timer = setInterval(tick, TICK_MS);
  await new Promise((rested) => setTimeout(rested, 5000)); // until the view has come to rest, and what waited is done
  const [before, timesBefore, begun] = [await mainThread(session), await processTimes(system), performance.now()];
  await page.evaluate(() => (window.frames_.length = window.taken_ = window.drawn_ = 0));
  await new Promise((over) => setTimeout(over, Number(values.seconds) * 1000));
  const [frames, ticks, drawn] = await page.evaluate(() => [window.frames_, window.taken_, window.drawn_]);
  const [after, timesAfter, seconds] = [await mainThread(session), await processTimes(system), (performance.now() - begun) / 1000];
  clearInterval(timer);
  const perTick = (name) => ((after[name] - before[name]) * 1000) / ticks;
  const share = (type) => ((timesAfter[type] - timesBefore[type]) / seconds) * 100;
  const pauses = frames.slice(1).map((now, index) => now - frames[index]);
  return {
    ticks_a_second: ticks / seconds,
    main_thread_ms_a_tick: perTick('TaskDuration'),
    script_ms_a_tick: perTick('ScriptDuration'),
    style_and_layout_ms_a_tick: perTick('RecalcStyleDuration') + perTick('LayoutDuration'),
    frames_a_second: pauses.length / ((frames.at(-1) - frames[0]) / 1000),
    map_frames_a_second: drawn / ((frames.at(-1) - frames[0]) / 1000),
    longest_frame_ms: Math.max(...pauses),
    page_process_percent: share('renderer'),
    drawing_process_percent: share('GPU'),
    drawing_ms_a_picture: ((timesAfter.GPU - timesBefore.GPU) * 1000) / Math.max(drawn, 1),
  };
}

const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done))));

/** In the page: holds the map and draws small circles with it, a step for every frame. */
function dragAbout() {
  const canvas = document.querySelector('.maplibregl-canvas');
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const at = (angle) => ({ clientX: left + width / 2 + 60 * Math.cos(angle), clientY: top + height / 2 + 60 * Math.sin(angle), button: 0, bubbles: true });
  canvas.dispatchEvent(new MouseEvent('mousedown', { ...at(0), buttons: 1 }));
  const step = (now) => {
    document.dispatchEvent(new MouseEvent('mousemove', { ...at(now / 300), buttons: 1 }));
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

const CLICKS = 20;

/** The time in ms from a click at a vehicle in the list to the frame that shows its details, of some clicks while all fly. */
async function clickToDetails(page, count, tick) {
  const timer = setInterval(tick, TICK_MS);
  const times = [];
  for (let i = 0; i < CLICKS; ++i) {
    const took = page.evaluate(async (index) => {
      const frame = () => new Promise(requestAnimationFrame);
      const options = document.querySelectorAll('#vehicles [role=option]');
      const option = options[index % options.length];
      const name = option.querySelector('.name').textContent.trim();
      await frame();
      const begun = performance.now();
      option.click();
      while (document.querySelector('#selected h2')?.textContent !== name || !document.querySelector('#selected .details')) await frame();
      await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
      return performance.now() - begun;
    }, i * 2 + (i % 2));
    times.push(await took);
    await page.keyboard.press('Escape');
    await page.locator('#selected').waitFor({ state: 'detached' });
    await new Promise((over) => setTimeout(over, TICK_MS * 1.3));
  }
  clearInterval(timer);
  times.sort((a, b) => a - b);
  const [middle, p95] = [times[Math.floor(CLICKS / 2)], times[Math.ceil(CLICKS * 0.95) - 1]];
  return { clicks: CLICKS, vehicles: count, click_to_details_ms: middle, p95_ms: p95, longest_ms: times.at(-1) };
}

function tellClick(count, row) {
  rows.push(row);
  console.log(`page    ${String(count).padStart(3)} vehicles flying , click to details: ${row.click_to_details_ms.toFixed(0)} ms in the middle of ${CLICKS}, ${row.p95_ms.toFixed(0)} ms for 95 %, ${row.longest_ms.toFixed(0)} ms at most`);
}

/** The same vehicles with the same trails, standing still, then flying, then flying below a map that is dragged about. */
async function measure(browser, count, points, tell) {
  const station = await startStation(count);
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, colorScheme: 'dark' });
  try {
    // A page that is too slow falls behind: what counts is what it has taken, not what was sent.
    await page.addInitScript((pixels) => {
      if (pixels !== 1) Object.defineProperty(window, 'devicePixelRatio', { get: () => pixels });
      window.taken_ = window.drawn_ = 0;
      window.frames_ = [];
      let drawnIn = 0;
      const { drawElements } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.drawElements = function (...what) {
        if (drawnIn !== window.frames_.at(-1)) window.drawn_ += 1;
        drawnIn = window.frames_.at(-1);
        return drawElements.apply(this, what);
      };
      window.WebSocket = class extends WebSocket {
        constructor(...address) {
          super(...address);
          this.addEventListener('message', () => (window.taken_ += 1));
        }
      };
    }, Number(values.pixels));
    await page.goto(station.url);
    await page.locator(count ? `#vehicles [aria-setsize="${count}"]` : '.maplibregl-canvas').first().waitFor({ timeout: 60_000 });
    for (let i = 0; i < points; ++i) {
      station.tick();
      if (i % 25 === 24) await settled(page);
    }
    await page.keyboard.press('f');
    const session = await page.context().newCDPSession(page);
    const system = await browser.newBrowserCDPSession();
    // Of the thread's own clock: what other programs take of the processor is not counted.
    await session.send('Performance.enable', { timeDomain: 'threadTicks' });
    await page.evaluate(() => {
      const note = (now) => (window.frames_.push(now), requestAnimationFrame(note));
      requestAnimationFrame(note);
    });
    // Without vehicles there is nothing but the map: what this machine can do at best.
    for (const [moves, isDragged] of count ? [[false, false], [true, false], [true, true]] : [[false, false], [false, true]]) {
      if (isDragged) await page.evaluate(dragAbout);
      tell({ vehicles: count, trail_points: points, moves, dragged: isDragged, ...(await overSomeTime(page, session, system, () => station.tick(moves))) });
      if (moves && !isDragged) tellClick(count, await clickToDetails(page, count, () => station.tick(true)));
    }
  } finally {
    await page.close();
    station.stop();
  }
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const rows = [];
function tell(row) {
  rows.push(row);
  const figure = (key, digits = 1) => row[key].toFixed(digits);
  console.log(
    `page    ${String(row.vehicles).padStart(3)} vehicles ${row.moves ? 'flying ' : 'resting'}${row.dragged ? ', map dragged' : ''}, trails of ${row.trail_points}: main thread ${figure('main_thread_ms_a_tick')} ms a tick ` +
      `at ${figure('ticks_a_second')} ticks/s (script ${figure('script_ms_a_tick')}, style and layout ${figure('style_and_layout_ms_a_tick')}), ${figure('frames_a_second')} frames/s, ${figure('map_frames_a_second')} of the map, ` +
      `longest ${figure('longest_frame_ms', 0)} ms; page ${figure('page_process_percent', 0)} %, drawing ${figure('drawing_process_percent', 0)} % of a core${row.dragged ? `, ${figure('drawing_ms_a_picture', 0)} ms for a picture` : ''}`,
  );
}
try {
  for (const count of values.vehicles.split(',').map(Number)) await measure(browser, count, Number(values.points), tell);
} finally {
  await browser.close();
}
if (values.json) writeFileSync(values.json, JSON.stringify(rows));
