// A survey drone's tab: what it tells and is told, and what its camera sees, in both widths.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { axe, violations } from './axe.js';
import { test } from './fixtures.js';
import { openPanel } from './page.js';
import { planPicture } from './world.mjs';

const drone = {
  name: 'hawk',
  connected: true,
  words: [{ at: '2026-11-24T10:00:00Z', text: 'it climbs' }],
  state: 'AutonomousExplore',
  mode: 'GUIDED',
  armed: true,
  healthy: true,
  height_m: 12.4,
  battery: 0.81,
  coverage: 0.64,
  slots: { free: 3, taken: 4, unknown: 1 },
};
const withDrone = (message) =>
  message.type === 'vehicles' ? [{ type: 'survey', feed: 'survey', revision: 1, whole: true, drones: [drone] }, message] : [message];

for (const size of [
  { width: 1440, height: 900 },
  { width: 390, height: 844 },
]) {
  test(`shows what a survey drone has found and sees at ${size.width} px`, async ({ open, context, complaints }) => {
    const asked = [];
    let hasImage = true;
    await context.route('**/api/v1/survey/hawk/picture*', async (route) => {
      asked.push(new URL(route.request().url()).searchParams);
      const number = String(asked.length);
      if (hasImage)
        await route.fulfill({
          body: planPicture(),
          contentType: 'image/png',
          headers: { 'Lapwing-Number': number, 'Lapwing-Age-Ms': '80' },
        });
      else
        await route.fulfill({
          status: 504,
          contentType: 'application/problem+json',
          body: JSON.stringify({ detail: 'NoImage: the drone is reached and has given no picture for 3 s' }),
        });
    });
    const page = await open({ size, station: withDrone });
    const panel = await openPanel(page, 'Survey');
    await expect(panel).toContainText('12 m high');
    await expect(panel).toContainText('64 % of the lot seen');
    for (const [state, count] of Object.entries(drone.slots)) await expect(panel.locator(`.slots .${state} dd`)).toHaveText(String(count));
    assert.equal(asked.length, 0, 'nobody looks yet');

    await panel.getByRole('button', { name: 'Camera' }).click();
    const picture = panel.getByRole('img', { name: 'What hawk sees' });
    await expect.poll(() => picture.evaluate((image) => image.naturalWidth)).toBeGreaterThan(0);
    await expect(panel.locator('.delay')).toHaveText(/^\d+ ms$/);
    assert.equal(asked[0].get('view'), 'annotated');
    await panel.getByRole('button', { name: 'Large' }).click();
    const stop = await page.getByRole('button', { name: 'E-STOP' }).boundingBox();
    const seen = await picture.boundingBox();
    assert.ok(seen.y >= stop.y + stop.height && seen.width === size.width && seen.y + seen.height === size.height, JSON.stringify(seen));
    await expect(panel.locator('.delay')).toBeInViewport({ ratio: 1 });
    await page.evaluate(axe);
    assert.deepEqual(await violations(page), []);
    await page.keyboard.press('Escape');
    await expect.poll(async () => (await picture.boundingBox()).width).toBeLessThan(size.width);
    await panel.getByRole('button', { name: 'Large' }).click();
    await panel.getByRole('button', { name: 'Small' }).click();
    await panel.getByRole('button', { name: 'Plain' }).click();
    await expect.poll(() => asked.at(-1).get('view')).toBe('raw');
    await page.evaluate(axe);
    assert.deepEqual(await violations(page), []);

    complaints.areDue = true; // the browser tells of each answer that is none
    hasImage = false;
    await expect(panel.getByText('no image: NoImage')).toBeVisible();
  });
}
