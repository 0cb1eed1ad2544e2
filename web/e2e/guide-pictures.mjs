// Takes the pictures of README.md and of the guides, of the scripts that they tell of.
// usage: node e2e/guide-pictures.mjs [demo|first-mission|ground|survey|robot|explore]; needs the built program (LAPWING, default
// build/release/bin/lapwing) and web/dist.
import { execFile, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect } from '@playwright/test';
import { freeTcpPort } from './camera.mjs';
import { freeUdpPort, startBrowser } from './harness.mjs';
import { hold, openPanel } from './page.js';
import { planPicture, startWorld } from './world.mjs';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const program = process.env.LAPWING ?? path.join(root, 'build/release/bin/lapwing');
const browser = await startBrowser();

/** Starts the program; `url` is where its map is, once it has said so. */
function start(cwd, words) {
  const child = spawn(program, words, {
    cwd,
    env: { ...process.env, LAPWING_HOME: root, XDG_DATA_HOME: cwd },
    stdio: ['ignore', 'ignore', 'pipe'],
  });
  let said = '';
  const url = new Promise((resolve, reject) => {
    child.stderr.on('data', (data) => {
      said += data;
      const address = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
      if (address) resolve(address[0]);
    });
    child.once('exit', (code) => reject(new Error(`${program} ${words[0]} ended with ${code}: ${said}`)));
  });
  url.catch(() => {}); // not everything has a map
  return { url, end: () => child.kill('SIGINT') };
}

/** Shows what has a map to `look`, in a browser window. */
async function shown({ url }, options, look) {
  const { page, complaints } = await browser.open(await url, options);
  await look(page, (name, more) => page.screenshot({ path: path.join(root, 'docs/pictures', name), ...more }));
  if (complaints.length > 0) throw new Error(complaints.join('\n'));
}

async function withDemo(cwd, demoArguments, options, look) {
  const running = start(cwd, ['demo', ...demoArguments, '--port', '0']);
  try {
    await shown(running, options, look);
  } finally {
    running.end();
  }
}

const size = { width: 1280, height: 720 };
const vehicle = (page, name) => page.locator('#vehicles [role=option]', { hasText: name });
const atItem = async (page, items) => {
  await vehicle(page, 'copter 1').click();
  await page.locator('#selected .drawer', { hasText: items }).waitFor({ timeout: 180_000 });
};
const guide = readFileSync(path.join(root, 'docs/guide/first-mission.md'), 'utf8');
const script = guide.match(/```dolphin[^\n]*\n([\s\S]*?)```/)[1];
const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-guide-'));
/** The demo's map, and parameters. */
async function demo() {
  await withDemo(root, [], { scheme: 'dark', size: { width: 1440, height: 810 } }, async (page, picture) => {
    await atItem(page, /item 9/);
    await picture('map.png');

    const panel = page.locator('#parameters');
    await page.getByRole('tab', { name: /^Parameters/ }).click();
    await panel.getByRole('button', { name: 'Fetch parameters' }).click();
    await panel.getByLabel('Filter by name').fill('rtl');
    await panel.getByRole('button', { name: 'Change RTL_' }).first().click();
    await picture('parameters.png', { clip: await panel.boundingBox() });
  });
}

/** The script of the first mission in the air, and with a mistake. */
async function firstMission() {
  writeFileSync(path.join(folder, 'my.dolphin'), script);
  await withDemo(folder, ['--script', 'my.dolphin'], { scheme: 'light', size }, async (page, picture) => {
    await atItem(page, /item [45]/);
    await picture('first-mission.png');

    await page.getByRole('tab', { name: /^Script/ }).click();
    await page.locator('#script .chip', { hasText: 'done' }).waitFor({ timeout: 120_000 });
    await page.getByRole('button', { name: 'Edit' }).click();
    await page.getByLabel('Script text').fill(script.replace('takeOff', 'takeoff'));
    await page.locator('#script').getByRole('button', { name: 'Start' }).click();
    await page.getByText('did you mean takeOff?').first().click();
    await picture('first-mission-mistake.png');
  });
}

/** What lies on the ground: what was found, a plan that is being laid there, and what goes into a file. */
async function ground() {
  const world = await startWorld();
  try {
    const { page, complaints } = await browser.open(world.url, { scheme: 'light', size, reducedMotion: 'reduce' });
    const picture = (name) => page.screenshot({ path: path.join(root, 'docs/pictures', name) });
    await vehicle(page, 'copter 1').waitFor();
    await page.getByRole('tab', { name: /^Layers/ }).click();
    await page.getByRole('radio', { name: 'Plain', exact: true }).check();
    await page.getByRole('searchbox', { name: 'Find on the map' }).fill('door 222');
    await page.getByRole('button', { name: /^222/ }).click();
    const card = page.getByRole('article', { name: '222' });
    await card.getByRole('button', { name: /^Enlarge/, busy: false }).waitFor();
    await page.getByRole('searchbox', { name: 'Find on the map' }).fill('');
    await atRest(page);
    await picture('ground-found.png');
    await card.getByRole('button', { name: 'Close', exact: true }).click();

    await page.getByLabel('Lay a plan on the ground').setInputFiles({ name: 'office.png', mimeType: 'image/png', buffer: planPicture() });
    const sheet = page.getByRole('region', { name: 'Lay a plan on the ground' }).getByRole('application');
    await sheet.waitFor();
    const map = await page.locator('.map').boundingBox();
    const [drawer, dock] = [await page.locator('#selected').boundingBox(), await page.locator('#dock').boundingBox()];
    const middle = { x: (map.x + drawer.x) / 2, y: (map.y + dock.y) / 2 };
    const on = await sheet.boundingBox();
    const places = [[[0.01, 0.02], [-78, -48]], [[0.99, 0.02], [118, -48]], [[0.99, 0.98], [119, 69]]]; // prettier-ignore
    for (const [[u, v], [dx, dy]] of places) {
      await sheet.click({ position: { x: u * on.width, y: v * on.height } });
      await page.getByText(/^Now click the same place/).waitFor();
      await page.mouse.click(middle.x + dx, middle.y + dy);
    }
    await atRest(page);
    await picture('ground-plan.png');
    await page.getByRole('button', { name: 'Cancel' }).click();

    await page.getByRole('region', { name: 'Export' }).scrollIntoViewIfNeeded();
    await page.getByRole('region', { name: 'Export' }).getByRole('button', { name: 'Export' }).waitFor();
    await picture('ground-export.png');
    if (complaints.length > 0) throw new Error(complaints.join('\n'));
  } finally {
    await world.stop();
  }
}

/** A survey drone looks a car park over, told by its tab: on its way, and on a phone. */
async function survey() {
  const [link, port] = [await freeUdpPort(), await freeTcpPort()];
  const lot = '[[43.258599, -79.920346], [43.258599, -79.919854], [43.258797, -79.919854], [43.258797, -79.920346]]';
  writeFileSync(
    path.join(folder, 'onboard.toml'),
    `[bridge]\nlink = "udpin://127.0.0.1:${link}"\n[decide]\nstate_folder = "drone"\n[operator]\nport = ${port}\n` +
      `[camera]\nkind = "simulated"\nworld = "${root}/examples/car-park/small.toml"\nwidth = 640\nheight = 480\n` +
      `[survey]\narea = ${lot}\nfolder = "found"\n[stream]\nport = ${port + 80}\n[webrtc]\nport = ${port + 180}\n`,
  );
  const running = [
    start(folder, [
      'sim',
      '--vehicles',
      'copter:1',
      '--home',
      '43.2585,-79.9201,100',
      '--out',
      `udpout://127.0.0.1:${link}`,
      '--speedup',
      '1',
    ]),
    start(folder, ['onboard', '--config', 'onboard.toml']),
    start(folder, ['station', '--survey', `127.0.0.1:${port}`, '--port', '0']),
  ];
  try {
    await shown(running[2], { scheme: 'light', size: { width: 1280, height: 900 } }, async (page, picture) => {
      const panel = await openPanel(page, 'Survey');
      const button = (name) => panel.getByRole('button', { name, exact: true });
      // A copter that was just switched on refuses for a while.
      await expect(async () => {
        await hold(page, button('Arm'));
        await expect(button('Take off')).toBeEnabled();
      }).toPass({ timeout: 60_000 });
      await hold(page, button('Take off'));
      await expect(button('Explore')).toBeEnabled({ timeout: 60_000 });
      await hold(page, button('Explore'));
      await panel.getByRole('button', { name: 'Camera' }).click();
      const height = page.getByRole('separator', { name: 'Height of the panel' });
      for (let i = 0; i < 5; i += 1) await height.press('ArrowUp');
      await expect(panel.locator('.slots .free dd')).toHaveText(/^[4-9]|\d\d/, { timeout: 120_000 });
      await page.getByRole('button', { name: /^Fit/ }).click();
      await atRest(page);
      await page.getByRole('button', { name: 'Zoom in' }).click();
      await atRest(page);
      await picture('survey.png');
      await page.setViewportSize({ width: 390, height: 844 });
      await page.getByRole('tab', { name: /^Survey/ }).click();
      await atRest(page);
      await page.getByRole('button', { name: /^Fit/ }).click();
      await atRest(page);
      await picture('survey-phone.png');
    });
  } finally {
    for (const one of running.reverse()) one.end();
  }
}

/** A robot that maps an office: on its way, and how its parts are. */
async function robot() {
  const building = path.join(root, 'examples/buildings/office.toml');
  writeFileSync(
    path.join(folder, 'office.dolphin'),
    "robot = pick { id 'robot1'; timeout 60.seconds }\nexecute robot: drive { name 'Office'; explore(); returnToStart() }\n",
  );
  const words = ['--script', 'office.dolphin', '--vehicles', 'rover:1', '--robot', `sim:${building}`];
  await withDemo(folder, words, { scheme: 'light', size: { width: 1280, height: 900 } }, async (page, picture) => {
    const signs = () =>
      page.evaluate(async () => (await (await fetch('/api/v1/layers/points_of_interest/features')).json()).features.length);
    await expect.poll(signs, { timeout: 1_800_000, intervals: [5000] }).toBeGreaterThan(7);
    await page.screenshot({ path: '/tmp/shots/robot.png' });
    await vehicle(page, /robot ?1/).click();
    await page.getByRole('tab', { name: /^Layers/ }).click();
    await page.getByRole('radio', { name: 'Plain', exact: true }).check();
    const health = await openPanel(page, 'Health');
    await health.getByText('SIM').first().waitFor();
    await page.getByRole('button', { name: /^Fit/ }).click();
    await atRest(page);
    await picture('robot.png');
  });
}

/** A floor of rooms along a corridor as a ROS map, and what a robot drives to see all of it. */
async function explore() {
  const [width, height, cells_a_m] = [560, 320, 20];
  const floor = Buffer.alloc(width * height, 254);
  const wall = (x0, y0, x1, y1) => {
    for (let y = y0 * cells_a_m; y < y1 * cells_a_m; y += 1)
      for (let x = x0 * cells_a_m; x < x1 * cells_a_m; x += 1) floor[(height - 1 - Math.round(y)) * width + Math.round(x)] = 0;
  };
  const row = (y, doors) => [...doors, 28].reduce((from, door) => (wall(from, y, Math.min(door, 28), y + 0.15), door + 0.9), 0);
  for (const edge of [[0, 0, 28, 0.15], [0, 15.85, 28, 16], [0, 0, 0.15, 16], [27.85, 0, 28, 16]]) wall(...edge); // prettier-ignore
  row(6, [2, 6.5, 11, 16, 24]);
  row(8, [2, 7, 12.2, 18, 25]);
  for (const x of [4.5, 9, 14]) wall(x, 0, x + 0.15, 6);
  for (const x of [5, 10, 15, 21]) wall(x, 8, x + 0.15, 16);
  for (const thing of [[20, 0, 20.15, 3.5], [17, 2, 18, 3], [23, 2, 25, 3], [17, 11, 19, 12]]) wall(...thing); // prettier-ignore
  writeFileSync(path.join(folder, 'floor.pgm'), Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), floor]));
  const keys = { image: 'floor.pgm', resolution: 1 / cells_a_m, origin: '[0, 0, 0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.196 };
  const lines = Object.entries(keys).map(([key, value]) => `${key}: ${value}\n`);
  writeFileSync(path.join(folder, 'floor.yaml'), lines.join(''));
  await promisify(execFile)(program, ['explore', '--map', 'floor.yaml', '--start', '1,7,0', '--picture', 'floor.svg'], { cwd: folder });
  const { page } = await browser.open(`file://${folder}/floor.svg`, { size: { width: 557, height: 317 } });
  await page.screenshot({ path: path.join(root, 'docs/pictures/explore.png') });
}

/** Until the map has drawn what it has come to: the processor draws it here. */
const atRest = (page) => page.waitForTimeout(3000);

try {
  for (const take of Object.entries({ demo, 'first-mission': firstMission, ground, survey, robot, explore }))
    if (!process.argv[2] || process.argv[2] === take[0]) await take[1]();
} finally {
  await browser.stop();
  rmSync(folder, { recursive: true, force: true });
}
