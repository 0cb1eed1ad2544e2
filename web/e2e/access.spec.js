// Keyboards, screen readers, colours and small screens.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { row } from './page.js';

test('is usable by keyboard alone, in a sensible order', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  const names = [];
  for (let i = 0; i < 7; ++i) {
    await page.keyboard.press('Tab');
    names.push(
      await page.evaluate(() => (document.activeElement.ariaLabel || document.activeElement.textContent).trim().replace(/\s+/g, ' ')),
    );
    const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.notEqual(outline, 'none', `focus is not visible on ${names.at(-1)}`);
  }
  assert.equal(names[0], 'Skip to the vehicle table');
  assert.deepEqual(names.slice(2, 6), ['Settings', 'Help and keys', '■ STOP', 'E-STOP']);
  await page.keyboard.press('?');
  await page.getByRole('dialog', { name: 'Help' }).waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('dialog', { name: 'Help' }).waitFor({ state: 'hidden' });
  await page.keyboard.press('2');
  await page.locator('#vehicles tr.selected', { hasText: 'copter 2' }).waitFor();
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !document.querySelector('#vehicles tr.selected'));
});

test('has landmarks, names and one heading of each kind for screen readers', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  const faults = await page.evaluate(() => {
    const found = [];
    for (const landmark of ['header', 'main', 'h1']) {
      if (document.querySelectorAll(landmark).length !== 1) found.push(`not one ${landmark}`);
    }
    if (!document.documentElement.lang) found.push('no language');
    for (const control of document.querySelectorAll('button, a[href], input, select, textarea')) {
      const name = control.ariaLabel || control.textContent.trim() || control.labels?.[0]?.textContent.trim();
      if (!name) found.push(`no name: ${control.outerHTML.slice(0, 100)}`);
    }
    for (const cell of document.querySelectorAll('th')) if (!cell.scope) found.push(`th without scope: ${cell.textContent}`);
    const ids = [...document.querySelectorAll('[id]')].map((element) => element.id);
    if (new Set(ids).size !== ids.length) found.push('an id twice');
    if (!document.querySelector('[aria-live=polite]') || !document.querySelector('[aria-live=assertive]')) found.push('no live regions');
    return found;
  });
  assert.deepEqual(faults, []);
});

test('tells the state of the script on a phone', async ({ open }) => {
  const page = await open({ size: { width: 390, height: 844 } });
  await page.locator('header .state', { hasText: 'running' }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  for (const tab of ['Command', 'Params', 'Tasks', 'Script', 'Log', 'Vehicles']) {
    await page.getByRole('button', { name: tab, exact: true }).click();
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, tab);
  }
});

for (const scheme of ['dark', 'light']) {
  test(`has enough contrast in ${scheme} colours`, async ({ open }) => {
    const page = await open({ scheme });
    await row(page, 'copter 1').waitFor();
    const ratios = await page.evaluate(() => {
      const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
      const luminance = (colour) => {
        canvas.fillStyle = colour;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((c) =>
          c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4,
        );
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const style = getComputedStyle(document.documentElement);
      const value = (name) => style.getPropertyValue(name);
      const panel = luminance(value('--panel'));
      return ['--text', '--muted', '--ready', '--active', '--warning', '--critical', '--lost'].map((name) => {
        const ink = luminance(value(name));
        return [name, (Math.max(ink, panel) + 0.05) / (Math.min(ink, panel) + 0.05)];
      });
    });
    for (const [name, ratio] of ratios) assert.ok(ratio >= 4.5, `${name} has ${ratio.toFixed(2)}`);
  });
}

test('works 360 px wide', async ({ open }) => {
  const page = await open({ size: { width: 360, height: 740 } });
  await row(page, 'copter 1').waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  const cut = await page.evaluate(() => {
    const body = document.querySelector('#vehicles .body');
    return body.scrollWidth - body.clientWidth;
  });
  assert.ok(cut <= 0, `the table is ${cut} px too wide`);
  const stop = await page.getByRole('button', { name: 'STOP', exact: true }).boundingBox();
  assert.ok(stop.x + stop.width <= 360 && stop.height >= 44, 'STOP is in sight and large enough for a finger');
  await page.getByRole('button', { name: 'Script' }).click();
  await page.locator('#script li', { hasText: 'north = mission' }).waitFor();
  assert.ok(!(await page.locator('#vehicles').isVisible()));
});

test('keeps the colours that were chosen', async ({ open }) => {
  const page = await open({ scheme: 'dark' });
  await page.locator('html[data-theme=dark]').waitFor();
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.locator('html[data-theme=light]').waitFor();
  await page.reload();
  await page.locator('html[data-theme=light]').waitFor();
});
