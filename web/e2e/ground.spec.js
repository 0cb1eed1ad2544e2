// What lies on the ground: base maps, floors, what was found, plans that people lay there, files of it, and how it was.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';
import { expect } from '@playwright/test';
import { axe, violations } from './axe.js';
import { test } from './fixtures.js';
import { openPanel, row } from './page.js';
import { startFleet } from './harness.mjs';
import { fill, GROUNDS, planPicture } from './world.mjs';

const WIDE = { width: 1440, height: 900 };
const openWorld = async (open, world, options = {}) => {
  const page = await open({ url: world.url, size: WIDE, ...options });
  await row(page, 'copter 1').waitFor();
  return page;
};

/** In the middle of what is in sight of the map. */
const middle = async (page) => {
  const map = await page.locator('.map').boundingBox();
  const drawer = await page
    .locator('#selected')
    .boundingBox({ timeout: 500 })
    .catch(() => null);
  const dock = await page.locator('#dock').boundingBox();
  return { x: Math.round((map.x + (drawer?.x ?? map.x + map.width)) / 2), y: Math.round((map.y + dock.y) / 2) };
};

/** The colour of the page there, as it is on the screen: of a PNG of one pixel the first bytes, however its line is filtered. */
async function colourAt(page, { x, y }) {
  const shot = await page.screenshot({ clip: { x, y, width: 1, height: 1 } });
  const parts = [];
  for (let at = 8; at < shot.length; at += 12 + shot.readUInt32BE(at))
    if (shot.subarray(at + 4, at + 8).equals(Buffer.from('IDAT'))) parts.push(shot.subarray(at + 8, at + 8 + shot.readUInt32BE(at)));
  return [...inflateSync(Buffer.concat(parts)).subarray(1, 4)];
}
const isNear = (a, b) => a.every((value, index) => Math.abs(value - b[index]) < 12);

/** Clicks there until that is shown: what the map has just come to is found once it has drawn it. */
const clickFor = (page, { x, y }, shown) =>
  expect(async () => {
    await page.mouse.click(x, y);
    await shown.waitFor({ timeout: 1000 });
  }).toPass();

/** Somewhere on the map where nothing is drawn but its ground. */
const bareGround = async (page) => {
  const map = await page.locator('.map').boundingBox();
  return { x: Math.round(map.x + map.width - 30), y: Math.round(map.y + 150) };
};

test('begins where the map holds something when no vehicle was heard', async ({ open }) => {
  const station = await startFleet(undefined);
  try {
    await fill(station.url);
    const page = await open({ url: station.url, size: WIDE });
    const scale = page.locator('.maplibregl-ctrl-scale');
    await expect(scale).toHaveText(/^\d+\sm$/);
    await page.getByRole('button', { name: 'Zoom out' }).click();
    await page.getByRole('button', { name: 'Zoom out' }).click();
    await expect(scale).toHaveText(/^50\sm$/);
    await page.getByRole('button', { name: 'Fit the vehicles' }).click();
    await expect(scale).toHaveText(/^10\sm$/);
  } finally {
    await station.stop();
  }
});

test('shows base maps of each kind, and thanks who made them', async ({ open, world }) => {
  const page = await openWorld(open, world, { scheme: 'dark' });
  await openPanel(page, 'Layers');
  const place = await bareGround(page);
  const choose = (name) => page.getByRole('radio', { name, exact: true }).check();
  await choose('Plain');
  const plain = await colourAt(page, place);
  for (const [name, colour] of Object.entries(GROUNDS)) {
    await choose(name);
    await expect.poll(async () => isNear(await colourAt(page, place), colour), name).toBe(true);
  }
  await choose('Archive');
  await page.getByText('the tile makers').waitFor();
  await choose('Yard');
  await expect.poll(async () => isNear(await colourAt(page, place), [20, 32, 25]), 'drawn ground').toBe(true);
  await choose('Lines');
  await expect.poll(async () => isNear(await colourAt(page, place), [18, 48, 63]), 'water of vector tiles').toBe(true);
  await page.getByRole('button', { name: 'Colours' }).click();
  await expect.poll(async () => isNear(await colourAt(page, place), [188, 215, 230]), 'the same by day').toBe(true);
  await choose('Plain');
  await expect.poll(async () => isNear(await colourAt(page, place), GROUNDS.Archive)).toBe(false);
  assert.ok(plain);
});

test('tells why a base map cannot be seen', async ({ open, world, complaints }) => {
  complaints.areDue = true; // the browser complains, too
  const page = await openWorld(open, world);
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByLabel('Map tiles').fill('http://192.0.2.1/{z}/{x}/{y}.png');
  await page.getByRole('button', { name: 'Done' }).click();
  await page.locator('.thanks').getByRole('status').filter({ hasText: 'cannot be shown' }).waitFor();
});

test('shows what lies on a floor on that floor, and finds it by its words', async ({ open, world }) => {
  const page = await openWorld(open, world);
  await openPanel(page, 'Layers');
  await page.getByRole('searchbox', { name: 'Find on the map' }).fill('door 222');
  await page.getByRole('button', { name: /^222/ }).click();
  const card = page.getByRole('article', { name: '222' });
  await card.getByText('Dr Lark').waitFor();
  await page.getByRole('radio', { name: '1', exact: true }).waitFor();
  assert.ok(await page.getByRole('radio', { name: '1', exact: true }).isChecked(), 'its floor is shown');
  await card.getByRole('button', { name: /^Enlarge/ }).click();
  await page.evaluate(axe);
  assert.deepEqual(await violations(page), [], 'with a picture enlarged');
  await page.keyboard.press('Escape');

  // The map came to it: a click there finds it; on the other floor there is nothing.
  const place = await middle(page);
  await card.getByRole('button', { name: 'Close', exact: true }).click();
  await clickFor(page, place, card);
  await card.getByRole('button', { name: 'Close', exact: true }).click();
  await page.locator('.floors label', { hasText: '0' }).click();
  await expect.poll(async () => isNear(await colourAt(page, place), [90, 174, 255])).toBe(false);
  await page.mouse.click(place.x, place.y);
  assert.equal(await card.count(), 0);
  // Out to the car park and in again in one gesture.
  const scale = page.locator('.maplibregl-ctrl-scale');
  const near = await scale.textContent();
  await page.mouse.move(place.x, place.y);
  for (let i = 0; i < 6; i += 1) await page.mouse.wheel(0, 400);
  // Until the view has come to rest: what is turned while it glides adds up to something else.
  let far;
  await expect.poll(async () => far === (far = await scale.textContent()) && far !== near, { intervals: [500] }).toBe(true);
  await page.locator('.floors label', { hasText: '1' }).click();
  await page.mouse.move(place.x, place.y);
  for (let i = 0; i < 6; i += 1) await page.mouse.wheel(0, -400);
  await expect.poll(() => scale.textContent()).toBe(near);
  await clickFor(page, place, card);
});

test('lays a plan on the ground by places that are found in both, and adjusts it', async ({ open, world }) => {
  const page = await openWorld(open, world);
  await openPanel(page, 'Layers');
  await page.getByRole('searchbox', { name: 'Find on the map' }).fill('door 222');
  await page.getByRole('button', { name: /^222/ }).click();
  await page.getByRole('article', { name: '222' }).getByRole('button', { name: 'Close', exact: true }).click();
  await page.getByLabel('Lay a plan on the ground').setInputFiles({ name: 'office.png', mimeType: 'image/png', buffer: planPicture() });
  const panel = page.getByRole('region', { name: 'Lay a plan on the ground' });
  const sheet = panel.getByRole('application');
  await sheet.waitFor();
  const { x, y } = await middle(page);
  const size = await sheet.boundingBox();
  for (const [[u, v], [dx, dy]] of [
    [
      [0.02, 0.03],
      [-120, -70],
    ],
    [
      [0.98, 0.97],
      [120, 74],
    ],
  ]) {
    await sheet.click({ position: { x: u * size.width, y: v * size.height } });
    await panel.getByText(/^Now click the same place/).waitFor();
    await page.mouse.click(x + dx, y + dy);
  }
  await panel.getByText(/^It lies on the map/).waitFor();
  await page.evaluate(axe);
  assert.deepEqual(await violations(page), [], 'with a plan that is being laid');
  await panel.getByRole('button', { name: 'Save' }).click();
  await panel.waitFor({ state: 'detached' });
  const list = page.getByRole('region', { name: 'Floor plans' });
  await list.getByText(/^office /).waitFor();
  const paper = await middle(page); // the drawer has gone
  await expect
    .poll(async () => isNear(await colourAt(page, { x: x + 60, y: y + 40 }), [255, 255, 255]), 'its paper is on the map')
    .toBe(true);
  assert.ok(paper);
  await list.getByRole('button', { name: /^Adjust office/ }).click();
  await panel.getByText(/^It lies on the map, 1 cm off/).waitFor();
  await panel.getByRole('button', { name: 'Cancel' }).click();
  await list.getByRole('button', { name: /^Remove office/ }).click();
  await list.getByRole('button', { name: /^Really remove office/ }).click();
  await list.getByText(/^office /).waitFor({ state: 'detached' });
});

test('writes a file of what is chosen', async ({ open, world }) => {
  const page = await openWorld(open, world);
  await openPanel(page, 'Layers');
  const panel = page.getByRole('region', { name: 'Export' });
  await panel.getByRole('checkbox', { name: 'Tracks' }).uncheck();
  const download = page.waitForEvent('download');
  await panel.getByRole('button', { name: 'Export', exact: true }).click();
  const file = await download;
  assert.match(file.suggestedFilename(), /^lapwing-geopackage-.*\.gpkg$/);
  assert.equal(
    readFileSync(await file.path())
      .subarray(0, 15)
      .toString(),
    'SQLite format 3',
  );
  await panel.getByText(/is saved/).waitFor();
  await panel.getByRole('combobox', { name: 'As' }).selectOption('ros');
  await panel.getByRole('button', { name: 'Export', exact: true }).click();
  await panel.getByRole('alert').filter({ hasText: 'nothing in the map' }).waitFor();
});

test('looks back, and never leaves in doubt that it does', async ({ open, world }) => {
  const page = await openWorld(open, world);
  await page.waitForTimeout(2500); // a past, of which the station keeps two moments a second
  await page.getByRole('button', { name: 'Look back' }).click();
  const bar = page.getByRole('region', { name: 'Looking back' });
  await bar.getByRole('slider', { name: 'Moment' }).and(page.locator(':enabled')).waitFor();
  await row(page, 'copter 1').waitFor();
  assert.equal(await page.getByRole('button', { name: 'STOP', exact: true }).count(), 0, 'no STOP that would stop nothing');
  const frame = await page.locator('div.past').evaluate((element) => getComputedStyle(element).borderTopColor);
  assert.equal(frame, 'rgb(224, 161, 0)');
  await page.getByText('You look back.').waitFor();
  await bar.getByRole('combobox', { name: 'Speed' }).selectOption('5');
  assert.ok((await bar.getByRole('combobox', { name: 'Session' }).locator('option').count()) >= 1);
  const time = bar.locator('time');
  await bar
    .getByRole('button', { name: 'Play' })
    .or(bar.getByRole('button', { name: 'Pause' }))
    .first()
    .waitFor();
  const slider = bar.getByRole('slider', { name: 'Moment' });
  await slider.focus();
  await page.keyboard.press('End');
  await expect.poll(() => slider.evaluate((input) => input.value !== input.min)).toBe(true);
  const latest = await time.getAttribute('datetime');
  await page.keyboard.press('Home');
  await expect.poll(() => time.getAttribute('datetime')).not.toBe(latest);
  await page.evaluate(axe);
  assert.deepEqual(await violations(page), [], 'looking back');
  await bar.getByRole('button', { name: 'Back to live' }).click();
  await page.locator('header .phase', { hasText: 'live' }).waitFor();
});
