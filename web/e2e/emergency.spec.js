// The emergency stop: always in sight, always told what became of it.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { hold, openPanel, row, selectedRow, sentBy, watchSent } from './page.js';

test('stops everything until it is released, for every viewer', async ({ open }) => {
  const page = await open();
  const other = await open();
  await page.bringToFront();
  await row(page, 'link lost').waitFor();
  await page.getByRole('button', { name: 'E-STOP' }).click();
  const banner = other.getByRole('region', { name: 'Emergency stop' });
  await banner.getByText('4 of 5 stopped').waitFor();
  assert.match(await banner.innerText(), /rover 5\s+… try \d+/);
  await row(page, 'copter 2').click();
  assert.ok(await page.locator('#command').getByRole('button', { name: 'Arm', exact: true }).isDisabled());
  assert.ok(await page.locator('#command').getByRole('button', { name: 'Land' }).isEnabled());
  await hold(other, banner.getByRole('button', { name: 'Release' }));
  await banner.waitFor({ state: 'detached' });
  await page.getByRole('region', { name: 'Emergency stop' }).waitFor({ state: 'detached' });
});

test('stops everything with the keyboard alone', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  await page.keyboard.press('Control+Shift+S');
  const banner = page.getByRole('region', { name: 'Emergency stop' });
  await banner.waitFor();
  await hold(page, banner.getByRole('button', { name: 'Release' }));
});

test('leads the keyboard to the release, and back to where it was', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  const list = page.getByRole('listbox', { name: 'Vehicles' });
  await list.focus();
  await page.keyboard.press('Control+Shift+S');
  const banner = page.getByRole('region', { name: 'Emergency stop' });
  await banner.waitFor();
  await page.waitForFunction(() => document.activeElement.textContent.includes('Release'));
  await page.keyboard.down('Enter');
  await banner.waitFor({ state: 'detached' });
  await page.keyboard.up('Enter');
  assert.ok(await list.evaluate((element) => element === document.activeElement), 'the focus is where it was');
});

for (const size of [
  { width: 1440, height: 900 },
  { width: 390, height: 844 },
]) {
  test(`keeps Motors off away from Release, behind a second step, at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await row(page, 'copter 1').waitFor();
    await watchSent(page);
    await button(page).click();
    const banner = page.getByRole('region', { name: 'Emergency stop' });
    const release = banner.getByRole('button', { name: 'Release' });
    const first = banner.getByRole('button', { name: 'Motors off…' });
    const [a, b] = [await first.boundingBox(), await release.boundingBox()];
    assert.ok(b.x - (a.x + a.width) > 48, `${b.x - a.x - a.width} px between them`);
    await first.click();
    const second = banner.getByRole('group', { name: 'Motors off' }).getByRole('button', { name: 'Motors off', exact: true });
    const c = await second.boundingBox();
    assert.ok(c.y + c.height < a.y, 'the second step is not where the first was');
    assert.equal(await release.count(), 0, 'nobody who wants to release stops the motors');
    await second.click();
    await banner.getByRole('button', { name: 'Cancel' }).click();
    await release.waitFor();
    assert.deepEqual(await sentBy(page), ['emergency_stop'], 'a click stops no motor');
    await first.click();
    await hold(page, second);
    await banner.getByText('motors off, by').waitFor();
  });
}

test('has STOP and E-STOP large and apart enough for a finger on a phone', async ({ open }) => {
  const page = await open({ size: { width: 390, height: 844 } });
  await row(page, 'copter 1').waitFor();
  const [stop, emergency] = [await page.getByRole('button', { name: 'STOP', exact: true }).boundingBox(), await button(page).boundingBox()];
  for (const { width, height } of [stop, emergency]) assert.ok(width >= 44 && height >= 44, `${width} x ${height}`);
  assert.ok(emergency.x - (stop.x + stop.width) > 6, `${emergency.x - stop.x - stop.width} px between them`);
});

const button = (page) => page.locator('header .emergency');
/** Whole, large enough for a finger, and with nothing of the page over it or into its neighbours. */
const assertPressable = async (page, when) => {
  const faults = await page.evaluate(() => {
    const overlap = (a, b) => a.left < b.right - 0.5 && b.left < a.right - 0.5;
    const boxOf = (element) => element.getBoundingClientRect();
    const stop = document.querySelector('.app > header .emergency');
    const { left, right, top, bottom, width, height } = boxOf(stop);
    const found = [];
    if (left < 0 || right > innerWidth || width < 44 || height < 44) found.push(`at ${left} to ${right}, ${width} x ${height}`);
    for (const [x, y] of [
      [left + 12, top + 22],
      [right - 12, top + 22],
      [(left + right) / 2, bottom - 6],
    ]) {
      if (document.elementFromPoint(x, y) !== stop) found.push(`covered at ${x}, ${y}`);
    }
    const parts = [...document.querySelectorAll('.app > header :is(.phase, .state, button)')].filter((part) => boxOf(part).width > 0);
    parts.forEach((a, i) =>
      parts.slice(i + 1).forEach((b) => overlap(boxOf(a), boxOf(b)) && found.push(`${a.className} over ${b.className}`)),
    );
    return found;
  });
  assert.deepEqual(faults, [], when);
};

for (const size of [
  { width: 1280, height: 800 },
  { width: 667, height: 375 },
  { width: 375, height: 667 },
  { width: 320, height: 568 },
]) {
  test(`has E-STOP in sight and to press in every state at ${size.width} px`, async ({ complaints, open, station }) => {
    complaints.areDue = true;
    const page = await open({ size });
    await row(page, 'copter 2').waitFor();
    await assertPressable(page, 'at first');
    await row(page, 'copter 2').click();
    for (const tab of size.width < 900 ? ['Params', 'Tasks', 'Script', 'Log', 'Layers', 'Vehicle'] : []) {
      await openPanel(page, tab);
      await assertPressable(page, tab);
    }
    for (const name of ['Help', 'Settings']) {
      await page.locator('header').getByRole('button', { name }).click();
      await page.getByRole('dialog', { name }).waitFor();
      await assertPressable(page, name);
      await page.keyboard.press('Escape');
      await page.getByRole('dialog', { name }).waitFor({ state: 'hidden' });
      await selectedRow(page, 'copter 2').waitFor(); // Escape was the dialog's alone
    }
    await page.keyboard.press('?');
    await button(page).click();
    await page.getByRole('region', { name: 'Emergency stop' }).waitFor();
    await assertPressable(page, 'latched');
    await page
      .getByRole('button', { name: 'STOP', exact: true })
      .click()
      .catch(() => {});
    await assertPressable(page, 'stopping');
    await station().stop();
    await page.locator('header .phase', { hasText: 'station lost' }).waitFor();
    await assertPressable(page, 'lost');
    for (const name of ['Release', 'Motors off…']) assert.ok(await page.getByRole('button', { name }).isDisabled(), name);
  });
}

test('says that E-STOP does not reach a lost station', async ({ complaints, open, station, restart }) => {
  complaints.areDue = true;
  const page = await open({ size: { width: 375, height: 667 } });
  await row(page, 'copter 2').waitFor();
  await station().stop();
  await page.getByText('E-STOP does not reach them').waitFor();
  await page.getByRole('button', { name: 'E-STOP, which does not reach the station now' }).click();
  const notice = page.getByRole('group', { name: 'E-STOP failed', exact: true });
  await notice.getByText('The station did not answer.').waitFor();
  await page.getByRole('alert').getByText('E-STOP failed.').waitFor({ state: 'attached' });
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  await page.getByRole('group', { name: 'STOP failed', exact: true }).waitFor();
  await button(page).click();
  await notice.waitFor();
  await restart();
  await page.locator('header .phase', { hasText: 'live' }).waitFor();
  assert.ok(await notice.isVisible(), 'it is said until somebody has read it, or pressed again');
  await page.getByRole('button', { name: 'E-STOP', exact: true }).click();
  await page.getByRole('region', { name: 'Emergency stop' }).waitFor();
  await notice.waitFor({ state: 'detached' });
});

test('says soon that the station has not answered E-STOP', async ({ complaints, open, station }) => {
  complaints.areDue = true;
  const page = await open();
  await row(page, 'copter 2').waitFor();
  station().silence();
  await button(page).click();
  await page.getByRole('group', { name: 'Emergency stop not answered' }).getByText('stop the vehicles by remote control').waitFor();
  await page.getByRole('group', { name: 'E-STOP failed' }).waitFor();
});
