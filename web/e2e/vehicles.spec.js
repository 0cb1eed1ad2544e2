// The list of vehicles and the details of one.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { moves, row } from './page.js';

test('shows every vehicle, and they move', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  assert.equal(await page.locator('#vehicles [role=option]').count(), 5);
  assert.match(await row(page, 'copter 1').innerText(), /AUTO[\s\S]*20 m[\s\S]*%[\s\S]*\d′/);
  await moves(page, 'copter 1');
});

/** Its camera has been silent for ten seconds more than it has. */
const withOldCamera = (message) => {
  const older = ({ age_s = {}, ...vehicle }) => {
    const camera = age_s.component_100 === undefined ? {} : { component_100: age_s.component_100 + 10 };
    return { ...vehicle, age_s: { ...age_s, ...camera } };
  };
  return [message.type === 'vehicles' ? { ...message, vehicles: message.vehicles.map(older) } : message];
};

for (const size of [
  { width: 1280, height: 800 },
  { width: 900, height: 800 },
  { width: 390, height: 844 },
]) {
  test(`tells of the selected vehicle's health at ${size.width} px`, async ({ open }) => {
    const page = await open({ size, station: withOldCamera });
    await row(page, 'copter 1').click();
    const details = page.locator('#selected .details');
    await details
      .getByText(/about|\d–\d+ min/)
      .first()
      .waitFor();
    const text = await details.innerText();
    for (const part of [/RTK fixed, 14 satellites/, /compass 0\.6/, /Maker M1, standby/, /90° down, towards 046°/, /EKF3 compass variance/])
      assert.match(text, part);
    assert.doesNotMatch(await details.locator('dd', { hasText: 'active' }).first().innerText(), /ago/);
    await details
      .locator('dd', { hasText: 'Maker M1' })
      .getByText(/1\d s ago/)
      .waitFor();
    const panel = await page.locator('#selected').boundingBox();
    const inside = await details.boundingBox();
    assert.ok(inside.x >= panel.x && inside.x + inside.width <= panel.x + panel.width + 1, 'the details fit the panel');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), size.width);
    await page.keyboard.press('Escape');
    await details.waitFor({ state: 'detached' });
  });
}

for (const size of [
  { width: 1280, height: 800 },
  { width: 1024, height: 768 },
]) {
  test(`has each vehicle on a line that holds what it tells at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await row(page, 'link lost').waitFor();
    const lines = page.locator('#vehicles [role=option]');
    const list = await page.getByRole('listbox', { name: 'Vehicles' }).boundingBox();
    for (const line of await lines.all()) {
      const { y, height } = await line.boundingBox();
      assert.ok(y >= list.y && y + height <= list.y + list.height, 'every vehicle is in sight');
      assert.ok(height < 60, `${height} px high`);
    }
    await page.evaluate(() => {
      for (const state of document.querySelectorAll('#vehicles .state')) state.append(' STABILIZE STABILIZE');
      for (const link of document.querySelectorAll('#vehicles .left')) link.append('12 %');
    });
    for (const line of await lines.all()) assert.ok((await line.evaluate((one) => one.scrollWidth - one.clientWidth)) <= 0);
  });
}

test('tells a lost vehicle by word, sign and age', async ({ open }) => {
  const page = await open();
  await row(page, 'link lost').waitFor();
  assert.match(await row(page, 'rover 5').innerText(), /\? link lost/);
  await page.waitForFunction(() => parseFloat(document.querySelector('#vehicles .since').textContent) > 2);
});
