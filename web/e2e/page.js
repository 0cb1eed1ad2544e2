// What several tests do with a page.
import assert from 'node:assert/strict';

/** The line of a vehicle in the list. */
export const row = (page, name) => page.locator('#vehicles [role=option]', { hasText: name });
export const selectedRow = (page, name) => page.locator('#vehicles [role=option][aria-selected=true]', { hasText: name });
export const scriptState = (page, state) => page.locator('#script .chip', { hasText: state }).waitFor();

/** Opens a panel of the dock, if it is not open; gives it back. */
export async function openPanel(page, title) {
  const tab = page.getByRole('tab', { name: new RegExp(`^${title}`) });
  if ((await tab.getAttribute('aria-selected')) !== 'true') await tab.click();
  const panel = page.getByRole('tabpanel', { name: new RegExp(`^${title}`) });
  await panel.waitFor();
  return panel;
}
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

/** In the station that the tests have, "copter 1" is vehicle 1. */
const idOf = (name) => name.split(' ').at(-1);

/** Where the map has a vehicle, in px of the window; nothing where it has no place there. */
export const placeOnMap = (page, name) => page.evaluate((id) => document.querySelector('.map').placeOf?.(id), idOf(name));

/** Until that vehicle is drawn on the map, where the map has it. */
export const drawn = (page, name) =>
  page.waitForFunction((id) => {
    const place = document.querySelector('.map').placeOf?.(id);
    const sheet = document.querySelector('.overlay');
    if (!place || !sheet) return false;
    const { left, top, width } = sheet.getBoundingClientRect();
    const scale = sheet.width / width;
    const [x, y] = [(place.x - left) * scale, (place.y - top) * scale];
    const { data } = sheet.getContext('2d').getImageData(Math.round(x) - 1, Math.round(y) - 1, 3, 3);
    return data.some((value, index) => index % 4 === 3 && value > 200);
  }, idOf(name));

/** Until that vehicle has moved on the map, and is drawn where it is then. */
export async function moves(page, name) {
  await drawn(page, name);
  const { x, y } = await placeOnMap(page, name);
  await page.waitForFunction(
    ([id, left, top]) => {
      const now = document.querySelector('.map').placeOf(id);
      return Math.hypot(now.x - left, now.y - top) > 5;
    },
    [idOf(name), x, y],
  );
  await drawn(page, name);
}

/** Every vehicle lies on the map beside the panels, not below them. */
export const inSight = (page) =>
  page.waitForFunction(() => {
    const boxes = [...document.querySelectorAll('.panel, header, .sheet .body')].map((panel) => panel.getBoundingClientRect());
    const places = ['1', '2', '3', '4', '5'].map((id) => document.querySelector('.map').placeOf?.(id));
    const isCovered = ({ x, y }) => boxes.some((box) => x > box.left && x < box.right && y > box.top && y < box.bottom);
    return places.every((place) => place && place.x > 22 && place.y > 22 && place.x + 22 < innerWidth && !isCovered(place));
  });

export async function assertNoWider(page, width, when = '') {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width, when);
}
