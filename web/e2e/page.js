// What several tests do with a page.
import assert from 'node:assert/strict';

/** The line of a vehicle in the table. */
export const row = (page, name) => page.locator('#vehicles tbody tr', { hasText: name });
export const scriptState = (page, state) => page.locator('#script .chip', { hasText: state }).waitFor();
export const live = (page) => page.locator('header .phase', { hasText: 'live' }).waitFor();

/** Holds a button down with the mouse until that has confirmed it. */
export async function hold(page, button) {
  await page.bringToFront();
  await button.hover();
  await page.mouse.down();
  await page.locator('.button.held').waitFor();
  await page.locator('.button.held').waitFor({ state: 'detached' });
  await page.mouse.up();
}

/** From now on `sentBy` knows the actions of the commands that the page sends. */
export const watchSent = (page) =>
  page.evaluate(() => {
    window.sent = [];
    const send = WebSocket.prototype.send;
    WebSocket.prototype.send = function (text) {
      const { type, action } = JSON.parse(text);
      if (type !== 'ping') window.sent.push(action ?? type);
      return send.call(this, text);
    };
  });
export const sentBy = (page) => page.evaluate(() => window.sent);

/** Until that vehicle's marker has moved on the screen. */
export async function moves(page, name) {
  const marker = page.locator(`.vehicle[aria-label^="${name}"]`);
  const { x, y } = await marker.boundingBox();
  await page.waitForFunction(
    ([label, left, top]) => {
      const now = document.querySelector(`.vehicle[aria-label^="${label}"]`).getBoundingClientRect();
      return Math.hypot(now.x - left, now.y - top) > 5;
    },
    [name, x, y],
  );
}

/** Every vehicle's marker lies on the map beside the panels, not below them. */
export const inSight = (page) =>
  page.waitForFunction(() => {
    const panels = [...document.querySelectorAll('.panel:not([hidden]), header, nav.tabs')].map((panel) => panel.getBoundingClientRect());
    const markers = [...document.querySelectorAll('.vehicle')].map((marker) => marker.getBoundingClientRect());
    const isCovered = (x, y) => panels.some((panel) => x > panel.left && x < panel.right && y > panel.top && y < panel.bottom);
    return markers.length === 5 && markers.every(({ x, y }) => x > 0 && y > 0 && x + 44 < innerWidth && !isCovered(x + 22, y + 22));
  });

export async function assertNoWider(page, width, when = '') {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width, when);
}
