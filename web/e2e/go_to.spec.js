// Sending vehicles to a place on the map.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { hold, placeOnMap, row, selectedRow } from './page.js';

const chosen = (page) => page.getByRole('img', { name: 'the chosen place' });
const cross = (page) => page.getByRole('application', { name: 'The place to go to' });
const middleOf = async (locator) => {
  const { x, y, width, height } = await locator.boundingBox();
  return { x: x + width / 2, y: y + height / 2 };
};
const hasFocus = (locator) => locator.evaluate((element) => element === document.activeElement);

test('sends a vehicle to a place on the map', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await page.getByRole('button', { name: 'Go to…' }).click();
  await page.locator('.maplibregl-canvas').click({ position: { x: 500, y: 420 } });
  await chosen(page).waitFor();
  assert.equal(await cross(page).count(), 0);
  await hold(page, page.getByRole('button', { name: 'Go there' }));
  await page.locator('#command summary', { hasText: 'Go to' }).waitFor();
  const sent = page.getByRole('img', { name: /^destination of copter 2, \d+ m$/ });
  await sent.waitFor();
  await page.locator('#command details', { hasText: 'Go to' }).getByText('reached').waitFor();
  await sent.waitFor({ state: 'detached' });
});

test('keeps the height on the way to a place unless another one is given', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  const height = page.getByLabel('Height to go at');
  assert.match(await height.getAttribute('placeholder'), /^keep -?\d+$/);
  const sentHeights = await page.evaluate(() => {
    window.heights = [];
    const send = WebSocket.prototype.send;
    WebSocket.prototype.send = function (text) {
      const { action, height_m } = JSON.parse(text);
      if (action === 'go_to') window.heights.push(height_m ?? 'as it is');
      return send.call(this, text);
    };
  });
  assert.equal(sentHeights, undefined);
  for (const given of ['', '35']) {
    await page.getByRole('button', { name: 'Go to…' }).click();
    await page.locator('.maplibregl-canvas').click({ position: { x: 500, y: 420 } });
    await height.fill(given);
    await hold(page, page.getByRole('button', { name: 'Go there' }));
  }
  await page.locator('#command summary', { hasText: 'Go to, 35 m' }).waitFor();
  assert.deepEqual(await page.evaluate(() => window.heights), ['as it is', 35]);
  assert.equal(await height.inputValue(), '', 'the next place is at its own height again');
});

test('sends a vehicle to a place by keyboard alone', async ({ open }) => {
  const page = await open();
  await row(page, 'rover 5').waitFor();
  await page.keyboard.press('5'); // it stands still
  const goTo = page.getByRole('button', { name: 'Go to…' });
  await goTo.press('Enter');
  await cross(page).waitFor();
  assert.ok(await hasFocus(cross(page)), 'the cross has the focus');
  assert.match(await cross(page).getByRole('status').textContent(), /^at rover 5$/);
  const before = await middleOf(cross(page));
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Shift+ArrowUp');
  const after = await middleOf(cross(page));
  assert.deepEqual([Math.round(after.x - before.x), Math.round(after.y - before.y)], [10, -100]);
  assert.match(await cross(page).getByRole('status').textContent(), /^[\d.]+ m at 00[5-7]° from rover 5$/);
  assert.equal(await cross(page).evaluate((element) => getComputedStyle(element).opacity), '1');
  await page.keyboard.press('Enter');
  await chosen(page).waitFor();
  const place = await middleOf(chosen(page));
  assert.ok(Math.hypot(place.x - after.x, place.y - after.y) < 2, 'the chosen place is where the cross was');
  const goThere = page.getByRole('button', { name: 'Go there' });
  await page.waitForFunction(() => document.activeElement.textContent.includes('Go there'));
  await page.keyboard.down('Enter');
  await page.locator('#command summary', { hasText: 'Go to' }).waitFor();
  await page.keyboard.down('Enter'); // as held keys repeat
  await page.keyboard.up('Enter');
  assert.equal(await goThere.count(), 0);
  assert.equal(await cross(page).count(), 0, 'a key that is held on does not begin anew');
  assert.ok(await hasFocus(goTo));
});

test('leaves the choice of a place with Escape, and keeps the cross in sight', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await row(page, 'copter 2').click();
  const goTo = page.getByRole('button', { name: 'Go to…' });
  await goTo.press('Enter');
  for (let i = 0; i < 8; ++i) await page.keyboard.press('Shift+ArrowRight');
  const { x } = await middleOf(cross(page));
  const { x: edge } = await page.locator('#selected').boundingBox();
  assert.ok(x < edge, `the cross is at ${x}, below the panel that begins at ${edge}`);
  await page.keyboard.press('Escape');
  await cross(page).waitFor({ state: 'detached' });
  await page.waitForFunction(() => document.activeElement.textContent.includes('Go to…'));
  assert.equal(await chosen(page).count(), 0);
  await selectedRow(page, 'copter 2').waitFor();

  await goTo.click();
  await page.keyboard.press('Control+Shift+S');
  await cross(page).waitFor({ state: 'detached' });
});

test('chooses the place of a vehicle, too, with a click at it', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await page.getByRole('button', { name: 'Go to…' }).click();
  const { x, y } = await placeOnMap(page, 'rover 5');
  await page.mouse.click(x, y);
  await chosen(page).waitFor();
  await selectedRow(page, 'copter 2').waitFor();
});
