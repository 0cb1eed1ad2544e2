// What the map shows, and what it leaves to the operator.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { test } from './fixtures.js';
import { inSight } from './page.js';

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
  await page.mouse.move(640, 600);
  await page.mouse.down();
  await page.mouse.move(640, 250, { steps: 5 });
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

test('shows no label over another', async ({ open }) => {
  const page = await open({ isSharp: true, size: { width: 1280, height: 800 } });
  await inSight(page);
  const onOneSpot = () =>
    page.evaluate(() => {
      const boxes = [...document.querySelectorAll('.vehicle')].map((marker) => marker.getBoundingClientRect());
      return boxes.every(({ x, y }) => Math.hypot(x - boxes[0].x, y - boxes[0].y) < 20);
    });
  while (!(await onOneSpot())) await page.keyboard.press('-'); // a press during a zoom counts from where the zoom is
  await page.waitForFunction(() => {
    const boxes = [...document.querySelectorAll('.vehicle .label')].map((label) => label.getBoundingClientRect());
    return boxes.every((a, i) =>
      boxes.slice(i + 1).every((b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 0.5 || b.bottom <= a.top + 0.5),
    );
  });
});
