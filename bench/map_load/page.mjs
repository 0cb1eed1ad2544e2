// The browser app at a station with a full map: what it costs, and how long after a write it is on the screen.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { probeSlot, put } from './content.mjs';

const fromWeb = createRequire(path.join(path.dirname(fileURLToPath(import.meta.url)), '../../web/package.json'));
const { chromium } = fromWeb('playwright-core');

const SIZE = { width: 1440, height: 900 };
export const pause = (ms) => new Promise((over) => setTimeout(over, ms));

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });

/**
 * In the page: counts frames and those in which the map was drawn, and looks at one pixel of each of these, or at all; and when one had
 * slots and points in it: so many corners an empty map has not.
 */
function watch() {
  window.frames_ = [];
  window.drawn_ = 0;
  let [isDrawn, corners] = [false, 0];
  const { drawElements } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.drawElements = function (...what) {
    // When the map is done with its frame, and before the browser takes the picture away.
    if (!isDrawn)
      queueMicrotask(() => {
        if (corners > 8_000) window.full_ ??= performance.now();
        [isDrawn, corners] = [false, 0];
        window.drawn_ += 1;
        window.look_?.(this);
      });
    isDrawn = true;
    corners += what[1];
    return drawElements.apply(this, what);
  };
  const note = (now) => (window.frames_.push(now), requestAnimationFrame(note));
  requestAnimationFrame(note);
  window.pixels_ = (gl, x, y, width, height) => {
    const bytes = new Uint8Array(4 * width * height);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
  };
}

export async function open(browser, url) {
  const page = await browser.newPage({ viewport: SIZE, colorScheme: 'light' });
  await page.addInitScript(watch);
  const begun = performance.now();
  await page.goto(url);
  await page.locator('.maplibregl-canvas').waitFor();
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  return { page, session, system: await browser.newBrowserCDPSession(), begun };
}

/** What the page's process has of the machine's memory, and the processor time of the one that draws so far. */
async function processes(system) {
  const { processInfo } = await system.send('SystemInfo.getProcessInfo');
  const resident_kb = ({ id }) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]);
  return {
    page_mb: Math.max(...processInfo.filter(({ type }) => type === 'renderer').map(resident_kb)) / 1024,
    drawing_s: processInfo.find(({ type }) => type === 'GPU').cpuTime,
  };
}

/** Waits until the map has not been drawn for a while; when it was drawn last, on the page's own clock. */
export function rested(page, quiet_ms = 700) {
  return page.evaluate(async (quiet) => {
    for (let [drawn, at] = [window.drawn_, performance.now()]; ; ) {
      await new Promise(requestAnimationFrame);
      if (drawn !== window.drawn_) [drawn, at] = [window.drawn_, performance.now()];
      else if (performance.now() - at > quiet && drawn > 0) return at;
    }
  }, quiet_ms);
}

async function metrics(session) {
  const { metrics: all } = await session.send('Performance.getMetrics');
  return Object.fromEntries(all.map(({ name, value }) => [name, value]));
}

/** Frames a second, and what the page's main thread did. */
export async function smoothness({ page, session, system }, seconds) {
  await page.evaluate(() => (window.frames_.length = window.drawn_ = 0));
  const [before, begun] = [await metrics(session), await processes(system)];
  await pause(seconds * 1000);
  const [frames, drawn] = await page.evaluate(() => [window.frames_, window.drawn_]);
  const [after, ended] = [await metrics(session), await processes(system)];
  const pauses = frames.slice(1).map((at, i) => at - frames[i]);
  const length_s = (frames.at(-1) - frames[0]) / 1000;
  await session.send('HeapProfiler.collectGarbage');
  return {
    frames_a_second: pauses.length / length_s,
    map_frames_a_second: drawn / length_s,
    longest_frame_ms: Math.max(...pauses),
    main_thread_percent: (100 * (after.TaskDuration - before.TaskDuration)) / seconds,
    drawing_ms_a_picture: ((ended.drawing_s - begun.drawing_s) * 1000) / Math.max(drawn, 1),
    page_mb: ended.page_mb,
    heap_mb: (await metrics(session)).JSHeapUsedSize / 1e6,
  };
}

/** Where on the canvas the probe lies: what differs between two pictures of it in one state and in the other, while nothing else changes. */
export async function findProbe(page, url) {
  await page.evaluate(() => {
    window.look_ = (gl) => (window.seen_ = { bytes: window.pixels_(gl, 0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight), width: gl.drawingBufferWidth });
  });
  const seen = async (state) => {
    await put(url, 'slots', probeSlot(state));
    await pause(600);
    await rested(page);
    await page.evaluate((name) => (window[name] = window.seen_), `seen_${state}`);
  };
  await seen('taken');
  await seen('free');
  return page.evaluate(() => {
    window.look_ = undefined;
    const [{ bytes: one, width }, { bytes: other }] = [window.seen_free, window.seen_taken];
    const places = [];
    for (let i = 0; i < one.length; i += 4) if (Math.abs(one[i] - other[i]) + Math.abs(one[i + 1] - other[i + 1]) + Math.abs(one[i + 2] - other[i + 2]) > 20) places.push(i / 4);
    if (places.length < 50) return undefined;
    const middle = (of) => of.sort((a, b) => a - b)[of.length >> 1];
    const at = { x: middle(places.map((i) => i % width)) - 4, y: middle(places.map((i) => Math.floor(i / width))) };
    const first = 4 * (at.y * width + at.x);
    window.colour_ = one.subarray(first, first + 4).join();
    return at;
  });
}

/** ms from a write over HTTP to the frame of the map that shows it, for so many writes. */
export async function writeToPainted(page, url, at, times) {
  const took = [];
  for (let i = 0; i < times; ++i) {
    await pause(150 + Math.random() * 200); // at any moment between two of the station's rounds
    const painted = page.evaluate(({ x, y }) => {
      return new Promise((done, fail) => {
        const timer = setTimeout(() => fail(new Error('never painted')), 10_000);
        window.look_ = (gl) => {
          const colour = window.pixels_(gl, x, y, 1, 1).join();
          if (colour === window.colour_) return;
          [window.colour_, window.look_] = [colour, undefined];
          clearTimeout(timer);
          done(performance.timeOrigin + performance.now());
        };
      });
    }, at);
    await pause(30); // the page looks now
    const sent = performance.timeOrigin + performance.now();
    await put(url, 'slots', probeSlot(i % 2 ? 'free' : 'taken'));
    took.push((await painted) - sent);
  }
  return took.sort((a, b) => a - b);
}

export const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.ceil(sorted.length * part) - 1)];
