// What the map shows, and what it leaves to the operator.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { test } from './fixtures.js';
import { drawn, inSight, openPanel, placeOnMap, row, selectedRow } from './page.js';

for (const size of [
  { width: 1280, height: 800 },
  { width: 1920, height: 1080 },
  { width: 390, height: 844 },
]) {
  test(`has every vehicle in sight from the start at ${size.width} px`, async ({ open }) => {
    const page = await open({ size, isSharp: true });
    await inSight(page);
  });
}

/** What it tells once the map has come to rest: the same in several pictures one after the other. */
const settled = (scale) =>
  scale.evaluate(async (element) => {
    for (let same = 0, text = ''; same < 10;) {
      await new Promise(requestAnimationFrame);
      same = element.textContent === text ? same + 1 : 0;
      text = element.textContent;
    }
    return element.textContent;
  });

test('leaves the view alone once the operator has moved it, until F', async ({ open }) => {
  let told = 0;
  const page = await open({
    isSharp: true,
    size: { width: 1280, height: 800 },
    station: (message) => ((told += message.type === 'vehicles'), [message]),
  });
  await inSight(page);
  await page.mouse.move(640, 450);
  await page.mouse.down();
  await page.mouse.move(640, 200, { steps: 5 });
  await page.mouse.up();
  const scale = page.locator('.maplibregl-ctrl-scale');
  await page.keyboard.press('-');
  await page.keyboard.press('-');
  await page.keyboard.press('-');
  const zoomedOut = await settled(scale);
  const before = told;
  await expect.poll(() => told, 'the vehicles have moved on').toBeGreaterThan(before + 7);
  assert.equal(await settled(scale), zoomedOut);
  await page.keyboard.press('f');
  await page.waitForFunction((before) => document.querySelector('.maplibregl-ctrl-scale').textContent !== before, zoomedOut);
  await inSight(page);
});

test('zooms about the middle of what the panels leave of the map', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 }, reducedMotion: 'reduce' });
  await openPanel(page, 'Log');
  await inSight(page);
  await page.locator('#vehicles').getByText('lost').waitFor(); // it stands still
  const [map, dock] = [await page.locator('.map').boundingBox(), await page.locator('#dock').boundingBox()];
  const middle = { x: map.x + map.width / 2, y: (map.y + dock.y) / 2 };
  const before = await placeOnMap(page, 'rover 5');
  await page.getByRole('button', { name: 'Zoom out' }).click();
  const wanted = { x: (before.x + middle.x) / 2, y: (before.y + middle.y) / 2 };
  await expect
    .poll(async () => {
      const { x, y } = await placeOnMap(page, 'rover 5');
      return Math.hypot(x - wanted.x, y - wanted.y);
    })
    .toBeLessThan(5);
});

test('goes to a survey drone where no vehicle is heard', async ({ open }) => {
  const drone = { name: 'drone1', connected: true, words: [], state: 'Idle', position: { lat_deg: 43.2585, lon_deg: -79.9201 } };
  const told = { type: 'survey', feed: 'survey', revision: 1, whole: true, drones: [drone] };
  const page = await open({ station: (message) => [message.type === 'vehicles' ? told : message] });
  await expect(page.locator('.readout')).toContainText(/43\.258\d+° N, 79\.920\d+° W/);
});

/** Coarse pages move the map at once, so a vehicle's place is right when it is asked for. */
const clickAt = async (page, name, modifiers = []) => {
  await drawn(page, name);
  const { x, y } = await placeOnMap(page, name);
  for (const key of modifiers) await page.keyboard.down(key);
  await page.mouse.click(x, y);
  for (const key of modifiers) await page.keyboard.up(key);
};
const names = (page) => page.locator('#vehicles [role=option][aria-selected=true] .name').allInnerTexts();

test('selects with clicks at the map, and tells where the selected one goes', async ({ open }) => {
  const page = await open({ size: { width: 1440, height: 1000 } });
  await inSight(page);
  await clickAt(page, 'rover 5');
  await selectedRow(page, 'rover 5').waitFor();
  await clickAt(page, 'rover 4', ['Shift']);
  await page.getByRole('heading', { name: '2 vehicles' }).waitFor();
  await page.keyboard.press('Escape');
  await page.locator('#selected').waitFor({ state: 'detached' });
});

test('selects what lies in a rectangle or a free line that is drawn on the map', async ({ open }) => {
  const page = await open();
  await inSight(page);
  const box = await page.locator('.map').boundingBox();
  const dock = await page.locator('#dock').boundingBox();
  const [left, right, top, bottom] = [box.x + 70, box.x + box.width - 4, box.y + 4, dock.y - 14];
  const drag = async (places) => {
    await page.mouse.move(...places[0]);
    await page.mouse.down();
    for (const place of places.slice(1)) await page.mouse.move(...place, { steps: 3 });
    await page.mouse.up();
  };
  // Beside the banner of alarms.
  await page.getByRole('button', { name: 'Acknowledge: copter 2' }).click();
  await page.keyboard.down('Shift');
  await drag([[right, bottom], [left, top]]); // prettier-ignore
  await page.keyboard.up('Shift');
  await page.getByRole('heading', { name: '5 vehicles' }).waitFor();
  await page.keyboard.press('Escape');

  await drawn(page, 'rover 5');
  const { x, y } = await placeOnMap(page, 'rover 5'); // it stands still
  await page.getByRole('button', { name: 'Select with a lasso' }).click();
  await drag([[x - 12, y - 12], [x + 12, y - 12], [x, y + 14]]); // prettier-ignore
  await expect.poll(() => names(page)).toEqual(['rover 5']);
  assert.equal(await page.getByRole('button', { name: 'Select with a lasso' }).getAttribute('aria-pressed'), 'false');
});

test('follows a vehicle until the map is moved', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await drawn(page, 'copter 2');
  await page.getByRole('button', { name: 'Follow the vehicle' }).click();
  const middle = async () => {
    const map = await page.locator('.map').boundingBox();
    const [drawer, dock] = [await page.locator('#selected').boundingBox(), await page.locator('#dock').boundingBox()];
    return { x: (map.x + drawer.x) / 2, y: (map.y + dock.y) / 2 };
  };
  const { x, y } = await middle();
  const coordinates = page.locator('.readout');
  const before = await coordinates.innerText();
  await expect.poll(() => coordinates.innerText(), 'the map goes along').not.toBe(before);
  const place = await placeOnMap(page, 'copter 2');
  assert.ok(Math.hypot(place.x - x, place.y - y) < 12, `at ${place.x}, ${place.y} rather than ${x}, ${y}`);
  await page.mouse.move(x, y + 60);
  await page.mouse.down();
  await page.mouse.move(x + 80, y, { steps: 4 });
  await page.mouse.up();
  await page.getByRole('button', { name: 'Follow the vehicle', pressed: false }).waitFor();
});

test('measures along places, by mouse and by keyboard', async ({ open }) => {
  const page = await open();
  await inSight(page);
  await page.getByRole('button', { name: 'Measure' }).click();
  const bar = page.getByRole('group', { name: 'Measure' });
  await page.locator('.maplibregl-canvas').click({ position: { x: 400, y: 420 } });
  await page.locator('.maplibregl-canvas').click({ position: { x: 600, y: 420 } });
  await bar
    .getByRole('status')
    .filter({ hasText: /^\d+ m$/ })
    .waitFor();
  const one = parseFloat(await bar.getByRole('status').innerText());
  const cross = page.getByRole('application', { name: 'The next place to measure to' });
  await cross.focus();
  await page.keyboard.press('Shift+ArrowUp');
  await page.keyboard.press('Enter');
  await expect.poll(async () => parseFloat(await bar.getByRole('status').innerText())).not.toBe(one);
  await bar.getByRole('button', { name: 'Back' }).click();
  await expect.poll(async () => parseFloat(await bar.getByRole('status').innerText())).toBe(one);
  await page.keyboard.press('Escape');
  await bar.waitFor({ state: 'detached' });
});

test('leaves out of the map what is not wanted there, and keeps that', async ({ open }) => {
  const page = await open();
  await drawn(page, 'rover 5');
  const isDrawn = () =>
    page.evaluate(() => {
      const sheet = document.querySelector('.overlay');
      return sheet
        .getContext('2d')
        .getImageData(0, 0, sheet.width, sheet.height)
        .data.some((value) => value > 0);
    });
  await openPanel(page, 'Layers');
  for (const name of ['Vehicles', 'Trails']) await page.getByRole('checkbox', { name, exact: true }).uncheck();
  await expect.poll(isDrawn).toBe(false);
  await page.reload();
  await openPanel(page, 'Layers');
  assert.equal(await page.getByRole('checkbox', { name: 'Vehicles', exact: true }).isChecked(), false);
  await page.getByRole('button', { name: 'As at first' }).click();
  await drawn(page, 'rover 5');
});

test('gives a robot that knows its place in the site alone a place on the map', async ({ open }) => {
  const robot = {
    id: '7',
    name: 'robot 7',
    family: 'robot',
    site_pose: { site: 'demo field', x_m: 20, y_m: 30, z_m: 0, yaw_rad: 0 },
    age_s: {},
  };
  const page = await open({
    station: (message) => [message.type === 'vehicles' ? { ...message, vehicles: [...message.vehicles, robot] } : message],
  });
  await row(page, 'robot 7').waitFor();
  await drawn(page, 'robot 7');
  await clickAt(page, 'robot 7');
  await selectedRow(page, 'robot 7').waitFor();
});

test('shows a crowd of 250 as few, with none beyond sight in the page, and who is selected by himself', async ({ open }) => {
  const crowd = Array.from({ length: 250 }, (_, index) => ({
    id: String(1000 + index),
    name: `copter ${1000 + index}`,
    family: 'copter',
    armed: true,
    position: { lat_deg: -35.3633 + Math.floor(index / 16) * 1e-5, lon_deg: 149.1652 + (index % 16) * 1e-5, alt_m: 600 },
    age_s: { heartbeat: 0.1 },
  }));
  const page = await open({
    station: (message) => [message.type === 'vehicles' ? { ...message, vehicles: [...message.vehicles, ...crowd] } : message],
  });
  await page.locator('#vehicles [aria-setsize="255"]').first().waitFor();
  assert.ok((await page.locator('#vehicles [role=option]').count()) < 40, 'only those in sight are in the page');
  await page.getByRole('searchbox', { name: /^Search vehicles/ }).fill('copter 1249');
  await row(page, 'copter 1249').click();
  await page.getByRole('heading', { name: 'copter 1249' }).waitFor();
  await drawn(page, 'copter 1249');
});
