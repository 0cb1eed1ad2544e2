// Starts a station to test against and a browser to look at it with.
import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from '@playwright/test';
import config from '../playwright.config.js';

const web = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const build = process.env.LAPWING_BUILD ?? path.join(web, '..', 'build', 'release');

/** Where a station keeps its map: no test may find there what another one has left. */
function dataHome() {
  const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-e2e-'));
  process.once('exit', () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

export const freeUdpPort = () =>
  new Promise((resolve) => {
    const probe = createSocket('udp4').bind(0, '127.0.0.1', () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });

/** A station over moving vehicles on a port; 0 picks a free one. With a token, only who has it gets in. */
export async function startStation(port = 0, token = '') {
  const program = path.join(build, 'src', 'station', 'station_demo');
  const child = spawn(program, [String(port), path.join(web, 'dist'), token], { stdio: ['ignore', 'pipe', 'ignore'] });
  const url = await new Promise((resolve, reject) => {
    child.stdout.once('data', (data) => resolve(String(data).trim()));
    child.once('error', () => reject(new Error(`${program} does not start: build the target station_demo first`)));
    child.once('exit', (code) => reject(new Error(`${program} ended with ${code}`)));
  });
  const ended = new Promise((resolve) => child.once('exit', resolve));
  return {
    url,
    port: Number(new URL(url).port),
    /** From now on it says nothing and hears nothing, and its connections stay. */
    silence: () => child.kill('SIGSTOP'),
    stop: async () => {
      child.kill('SIGKILL');
      await ended;
    },
  };
}

/** The program itself: a station with simulated vehicles, whose time runs faster, or with none. */
export async function startFleet(vehicles, speedup = 5, words = []) {
  const program = path.join(build, 'bin', 'lapwing');
  const link = `127.0.0.1:${await freeUdpPort()}`;
  const start = (...words) =>
    spawn(program, words, {
      env: { ...process.env, LAPWING_HOME: path.dirname(web), XDG_DATA_HOME: dataHome() },
      stdio: ['ignore', 'ignore', 'pipe'],
    });
  const station = start('station', '--link', `udpin://${link}`, '--port', '0', ...words);
  const home = ['--home', '47.3977,8.5456,488'];
  const children = [station];
  if (vehicles) children.push(start('sim', '--vehicles', vehicles, ...home, '--speedup', String(speedup), '--out', `udpout://${link}`));
  children[1]?.stderr.resume();
  const ended = Promise.all(children.map((child) => new Promise((resolve) => child.once('close', resolve))));
  const url = await new Promise((resolve, reject) => {
    let said = '';
    station.stderr.on('data', (data) => {
      const address = (said += data).match(/http:\/\/127\.0\.0\.1:\d+\//);
      if (address) resolve(address[0]);
    });
    station.once('error', () => reject(new Error(`${program} does not start: build the target lapwing first`)));
    station.once('exit', (code) => reject(new Error(`${program} ended with ${code}: ${said}`)));
  });
  return {
    url,
    stop: async () => {
      for (const child of children) child.kill('SIGKILL');
      await ended;
    },
  };
}

/**
 * Makes ready a page, and notes what goes wrong in it: errors, refused resources, violations of the content policy. `options.station`
 * is given each message of the station and tells what the page hears instead of it.
 */
export async function preparePage(page, options, complaints) {
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  if (options.size) await page.setViewportSize(options.size);
  await page.emulateMedia({ colorScheme: options.scheme ?? 'dark', reducedMotion: options.reducedMotion ?? 'no-preference' });
  if (options.isCoarse) await page.addInitScript(() => Object.defineProperty(window, 'devicePixelRatio', { get: () => 0.25 }));
  if (!options.station) return;
  await page.routeWebSocket(/\/api\/v1\/ws/, (socket) => {
    const server = socket.connectToServer();
    server.onMessage((data) => options.station(JSON.parse(data)).forEach((message) => socket.send(JSON.stringify(message))));
  });
}

/** For programs that are no tests. */
export async function startBrowser() {
  const browser = await chromium.launch(config.use.launchOptions);
  return {
    open: async (url, options = {}) => {
      const page = await browser.newPage({ viewport: config.use.viewport });
      const complaints = [];
      await preparePage(page, options, complaints);
      await page.goto(url);
      return { page, complaints };
    },
    stop: () => browser.close(),
  };
}
