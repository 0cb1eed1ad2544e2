// Buttons that are held to confirm.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { row, sentBy, watchSent } from './page.js';

/** Timers that the page starts from now on wait for `passTime`, so that a slow machine is not too late for what a test does meanwhile. */
const stopTime = (page) =>
  page.evaluate(() => {
    window.timers = new Map();
    let handles = 1e9;
    window.setTimeout = (run) => (window.timers.set(++handles, run), handles);
    const clear = window.clearTimeout;
    window.clearTimeout = (handle) => window.timers.delete(handle) || clear.call(window, handle);
  });
const passTime = (page) => page.evaluate(() => window.timers.forEach((run, handle) => window.timers.delete(handle) && run()));

const command = (page, name) => page.locator('#command').getByRole('button', { name, exact: true });
/** A page with copter 2 selected and a pointer or a key down on Arm; time stands still for its timers. */
const held = async (open, press) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await watchSent(page);
  const arm = command(page, 'Arm');
  await arm.hover();
  await stopTime(page);
  await press(page, arm);
  await page.locator('#command .held', { hasText: 'Arm' }).waitFor();
  return page;
};
/** As in Safari, where a click does not give a button the focus, which it would lose with its end. */
const byMouse = async (page) => {
  await page.evaluate(() => addEventListener('mousedown', (event) => event.preventDefault(), { capture: true }));
  await page.mouse.down();
};
const byKey = async (page, arm) => {
  await arm.focus();
  await page.keyboard.down('Enter');
};

for (const [by, press] of Object.entries({ mouse: byMouse, keyboard: byKey })) {
  test(`confirms what is held by ${by} to the end`, async ({ open }) => {
    const page = await held(open, press);
    await passTime(page);
    assert.deepEqual(await sentBy(page), ['arm']);
  });
  const ends = {
    'means another vehicle': { key: '3', then: (page) => page.locator('#selected h2', { hasText: 'plane 3' }).waitFor() },
    'is gone': { key: 'Escape', then: (page) => page.locator('#selected').waitFor({ state: 'detached' }) },
    'is disabled': {
      key: 'Control+Shift+S',
      then: (page) => page.locator('#command button:disabled', { hasText: 'Arm' }).first().waitFor(),
      sends: ['emergency_stop'],
    },
  };
  for (const [what, { key, then, sends = [] }] of Object.entries(ends)) {
    test(`confirms nothing when the button held by ${by} ${what}`, async ({ open }) => {
      const page = await held(open, press);
      await page.keyboard.press(key);
      await then(page);
      await passTime(page);
      assert.deepEqual(await sentBy(page), sends);
      assert.equal(await page.locator('.held').count(), 0);
    });
  }
}

test('hears assistive technology, which clicks twice, after a hold by keyboard too', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await watchSent(page);
  const arm = command(page, 'Arm');
  await arm.focus();
  await page.keyboard.down(' ');
  await page.locator('#command .held').waitFor();
  await page.keyboard.up(' ');
  await arm.evaluate((button) => button.click());
  const again = command(page, 'Again to confirm');
  await again.waitFor();
  assert.deepEqual(await sentBy(page), []);
  await again.evaluate((button) => button.click());
  assert.deepEqual(await sentBy(page), ['arm']);

  await arm.evaluate((button) => button.click());
  await again.waitFor();
  await page.keyboard.press('3');
  await arm.waitFor();
  assert.deepEqual(await sentBy(page), ['arm'], 'asked for one vehicle, it is not confirmed for another');
});
