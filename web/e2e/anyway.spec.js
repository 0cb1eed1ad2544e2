// What the station refuses as implausible, and an operator means all the same: against the program itself.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { test } from './fixtures.js';
import { openPanel, row } from './page.js';

/** Held by a key: what a vehicle tells about itself at first moves the buttons about. */
async function hold(page, button, shown) {
  await button.focus();
  await page.keyboard.down('Enter');
  await shown.waitFor();
  await page.keyboard.up('Enter');
}

test('takes off above the ceiling when somebody has told why', async ({ fleet, open }) => {
  const page = await open({ url: fleet.url });
  const panel = page.locator('#command');
  await row(page, 'copter 1').click();
  await openPanel(page, 'Log');
  await page.locator('#log').getByText('EKF3 IMU0 is using GPS').waitFor(); // or it refuses to be armed
  await page.getByLabel('Height to take off to').fill('130');
  const offer = panel.getByRole('button', { name: 'Do it anyway…' });
  await hold(page, panel.getByRole('button', { name: 'Take off' }), offer);
  await panel.getByRole('cell', { name: '130 m above home is above the ceiling of 120 m' }).waitFor();
  await offer.click();
  const form = panel.getByRole('group', { name: 'Do it anyway' });
  const anyway = form.getByRole('button', { name: 'Take off anyway' });
  assert.ok(await anyway.isDisabled(), 'not without a reason');
  await page.keyboard.type('permission of the tower');
  await expect(anyway).toBeInViewport({ ratio: 1 });
  await hold(page, anyway, panel.getByText(/ceiling allowed: permission of the tower/));
  await form.waitFor({ state: 'detached' });
  await panel.locator('.headline', { hasText: /Take off, 130 m: under way, at \d+ of 130 m/ }).waitFor();
  await page
    .locator('#log')
    .getByText(/\[ceiling\]: allowed: permission of the tower/)
    .waitFor();
});
