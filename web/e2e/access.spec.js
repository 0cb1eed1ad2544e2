// Keyboards, screen readers, colours and small screens.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { axe, violations } from './axe.js';
import { openPanel, row, selectedRow } from './page.js';

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
  assert.equal(names[0], 'Skip to the list of vehicles');
  assert.equal(names[1], '■ STOP');
  assert.deepEqual(names.slice(2, 7), ['Look back', 'Colours: system. Change', 'Settings', 'Help and keys', 'E-STOP']);
  await page.keyboard.press('?');
  await page.getByRole('dialog', { name: 'Help' }).waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('dialog', { name: 'Help' }).waitFor({ state: 'hidden' });
  await page.keyboard.press('2');
  await selectedRow(page, 'copter 2').waitFor();
  await page.keyboard.press('Escape');
  await selectedRow(page, '').waitFor({ state: 'detached' });
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
  for (const tab of ['Vehicle', 'Params', 'Tasks', 'Script', 'Log', 'Layers']) {
    await openPanel(page, tab);
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
  const cut = await row(page, 'copter 1').evaluate((card) => card.scrollWidth - card.clientWidth);
  assert.ok(cut <= 0, `the card is ${cut} px too wide for what it tells`);
  const stop = await page.getByRole('button', { name: 'STOP', exact: true }).boundingBox();
  assert.ok(stop.x + stop.width <= 360 && stop.height >= 44, 'STOP is in sight and large enough for a finger');
  await openPanel(page, 'Script');
  await page.locator('#script li', { hasText: 'north = mission' }).waitFor();
  assert.ok(await row(page, 'copter 1').isVisible(), 'the vehicles stay in sight');
});

test('keeps the colours that were chosen', async ({ open }) => {
  const page = await open({ scheme: 'dark' });
  await page.locator('html[data-theme=dark]').waitFor();
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.locator('html[data-theme=light]').waitFor();
  await page.reload();
  await page.locator('html[data-theme=light]').waitFor();
});

for (const size of [
  { width: 1440, height: 900 },
  { width: 390, height: 844 },
]) {
  test(`is found without fault by axe, whatever is open, at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await row(page, 'link lost').waitFor();
    await page.evaluate(axe);
    assert.deepEqual(await violations(page), [], 'at first');
    await page.keyboard.press('1');
    await page.locator('#selected .details').waitFor();
    assert.deepEqual(await violations(page), [], 'with a vehicle selected');
    for (const title of ['Script', 'Tasks', 'Log', 'Layers']) {
      await openPanel(page, title);
      assert.deepEqual(await violations(page), [], title);
    }
    await page.keyboard.press('Control+Shift+S');
    await page.getByRole('region', { name: 'Emergency stop' }).waitFor();
    assert.deepEqual(await violations(page), [], 'in an emergency stop');
  });
}

test.describe('for fingers', () => {
  test.use({ hasTouch: true, isMobile: true });
  for (const size of [
    { width: 390, height: 844 },
    { width: 320, height: 568 },
    { width: 1024, height: 768 },
  ]) {
    test(`has everything large enough at ${size.width} px`, async ({ open }) => {
      const page = await open({ size });
      await row(page, 'copter 1').tap();
      await page.locator('#selected .details').waitFor();
      const small = () =>
        page.evaluate(() =>
          [...document.querySelectorAll('button, [role=tab], [role=option], select, input:not([type=checkbox], [type=range])')]
            .filter((control) => !control.closest('.visually-hidden, dialog') && control.checkVisibility())
            .map((control) => [control, control.getBoundingClientRect()])
            .filter(([, { width, height }]) => width > 0 && (height < 43.5 || width < 32))
            .map(([control, { width, height }]) => `${control.ariaLabel ?? control.textContent.trim()}: ${width} x ${height}`),
        );
      assert.deepEqual(await small(), []);
      await openPanel(page, 'Log');
      assert.deepEqual(await small(), []);
    });
  }
});
