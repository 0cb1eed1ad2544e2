// The panel with a vehicle's parameters.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { openPanel, row } from './page.js';

test('fetches parameters when asked, finds one, sets it and tells what the vehicle holds', async ({ complaints, open }) => {
  complaints.areDue = true;
  const page = await open();
  const asked = [];
  page.on('request', (request) => request.url().includes('/parameters') && asked.push(request.url()));
  await row(page, 'copter 2').click();
  const panel = page.locator('#parameters');
  await openPanel(page, 'Parameters');
  await panel.getByRole('button', { name: 'Fetch parameters' }).waitFor();
  assert.deepEqual(asked, [], 'nothing is asked for before');
  // A busy machine may look too seldom to see it pass.
  await panel.evaluate((element) => {
    const note = () =>
      (window.progressSeen = (window.progressSeen ?? '') + (element.querySelector('progress')?.closest('label').innerText ?? ''));
    new MutationObserver(note).observe(element, { subtree: true, childList: true, characterData: true });
  });
  await panel.getByRole('button', { name: 'Fetch parameters' }).press('Enter');
  await panel.getByText('19 parameters fetched.').waitFor();
  assert.match(await page.evaluate(() => window.progressSeen), /Fetching, \d+ of 19/);
  await panel.getByLabel('Filter by name').fill('rtl');
  assert.equal(await panel.locator('tbody tr').count(), 1);

  const edit = (name) => panel.getByRole('button', { name: `Change ${name}` });
  await edit('RTL_ALT').press('Enter');
  const value = panel.getByLabel('New value of RTL_ALT');
  assert.ok(await value.evaluate((input) => input === document.activeElement), 'the value can be typed at once');
  await value.fill('0.5');
  await value.press('Enter');
  await panel.getByRole('alert').getByText('This parameter is an integer.').waitFor();
  await value.fill('2000');
  await value.press('Enter');
  await panel.getByRole('status').getByText('RTL_ALT is 2000 now, was 1500.').waitFor();
  assert.match(await panel.locator('tbody tr').innerText(), /RTL_ALT\s+2000/);
  await page.waitForFunction(() => document.activeElement.ariaLabel?.startsWith('Change RTL_ALT'));

  await panel.getByLabel('Filter by name').fill('speed');
  await edit('WPNAV_SPEED').click();
  await panel.getByLabel('New value of WPNAV_SPEED').fill('5000');
  await panel.getByRole('button', { name: 'Set', exact: true }).click();
  await panel.getByRole('alert').getByText('Vehicle 2 stored WPNAV_SPEED = 2000, not 5000.').waitFor();
  await page.waitForFunction(() => document.activeElement.ariaLabel === 'New value of WPNAV_SPEED');
  await page.keyboard.press('Escape');
  assert.match(await panel.locator('tbody tr').innerText(), /2000/, 'what it stored is shown');

  const [download] = await Promise.all([page.waitForEvent('download'), panel.getByRole('button', { name: 'Save as file' }).click()]);
  assert.equal(download.suggestedFilename(), 'vehicle-2.params');
});

test('says why parameters cannot be had', async ({ complaints, open }) => {
  complaints.areDue = true;
  const page = await open();
  await row(page, 'plane 3').click();
  const panel = page.locator('#parameters');
  await openPanel(page, 'Parameters');
  await panel.getByRole('button', { name: 'Fetch parameters' }).click();
  await panel.getByRole('alert').getByText('There is no vehicle 3.').waitFor();
  await row(page, 'copter 2').click({ modifiers: ['Shift'] });
  await panel.getByText('Select one vehicle').waitFor();
});

/** The panel of copter 2 with its list. */
const fetched = async (page) => {
  await row(page, 'copter 2').click();
  const panel = page.locator('#parameters');
  await openPanel(page, 'Parameters');
  await panel.getByRole('button', { name: 'Fetch parameters' }).press('Enter');
  await panel.getByText('19 parameters fetched.').waitFor();
  return panel;
};

test('tells when parameters came, and Tab goes on beside the button that fetched them', async ({ open }) => {
  const page = await open();
  const panel = await fetched(page);
  assert.match(await panel.locator('thead').innerText(), /Value, \d\d:\d\d:\d\d/);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.ariaLabel), 'Filter by name');
});

test('leaves the operator alone who does something else when the answer to a change comes', async ({ open }) => {
  const page = await open();
  const panel = await fetched(page);
  let answer;
  await page.route('**/parameters/value?*', (route) => (answer = () => route.continue()));
  await panel.getByRole('button', { name: 'Change RTL_ALT' }).press('Enter');
  await panel.getByLabel('New value of RTL_ALT').fill('2000');
  await page.keyboard.press('Enter');
  await panel.getByText('Setting…').waitFor();
  assert.ok(await panel.getByRole('button', { name: 'Fetch again' }).isDisabled());
  await panel.getByLabel('Filter by name').fill('speed');
  await answer();
  await panel.getByText('RTL_ALT is 2000 now, was 1500.').waitFor();
  await page.evaluate(() => new Promise(requestAnimationFrame));
  assert.equal(await page.evaluate(() => document.activeElement.ariaLabel), 'Filter by name');

  await panel.getByRole('button', { name: 'Change WPNAV_SPEED' }).click();
  await panel.getByLabel('New value of WPNAV_SPEED').fill('fast');
  await page.keyboard.press('Enter');
  await panel.getByText('This is no number.').waitFor();
  await row(page, 'plane 3').click();
  await panel.getByRole('button', { name: 'Fetch parameters' }).waitFor();
  assert.equal(await panel.getByRole('alert').textContent(), '', "what was wrong with one vehicle's value is not said of another");
});

test('does not wait for parameters of a station that is lost', async ({ complaints, open, station }) => {
  complaints.areDue = true;
  const page = await open();
  await row(page, 'copter 2').click();
  const panel = page.locator('#parameters');
  await openPanel(page, 'Parameters');
  await page.route('**/parameters?*', () => {}); // as over a link that is silent, not closed
  await panel.getByRole('button', { name: 'Fetch parameters' }).click();
  await panel.locator('progress').waitFor();
  await station().stop();
  await panel.getByRole('alert').getByText('The station did not answer.').waitFor();
  assert.equal(await panel.locator('progress').count(), 0);
});

test('can be opened however full the drawer is', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await row(page, 'copter 2').click();
  await page.getByRole('button', { name: 'Go to…' }).click();
  const { height } = await (await openPanel(page, 'Parameters')).boundingBox();
  assert.ok(height >= 120, `only ${height} px of it are in sight`);
});
