// The script, its tasks and its log.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { live, openPanel, row, scriptState } from './page.js';

test('shows the task tree and the line that runs', async ({ open }) => {
  const page = await open();
  await (await openPanel(page, 'Tasks')).locator('li.running', { hasText: 'north' }).first().waitFor();
  await openPanel(page, 'Script');
  await page.locator('#script li.current', { hasText: 'north = mission' }).waitFor();
});

test('stops the script with the button and starts it again', async ({ open }) => {
  const page = await open();
  await scriptState(page, 'running');
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  await scriptState(page, 'stopping');
  await scriptState(page, 'stopped');
  await page.locator('#script .outcome', { hasText: 'stopped by operator 1' }).waitFor();
  const colours = await page.evaluate(() =>
    ['--critical', '--muted'].map((name) => getComputedStyle(document.documentElement).getPropertyValue(name)),
  );
  const chip = await page.locator('#script .chip').evaluate((element) => getComputedStyle(element).getPropertyValue('--chip'));
  assert.ok(chip.trim() !== colours[0].trim() && chip.trim() === colours[1].trim(), `what an operator wanted is no failure: ${chip}`);
  await row(page, 'LOITER').first().waitFor();
  await page.locator('#script').getByRole('button', { name: 'Start' }).click();
  await scriptState(page, 'running');
});

test('stops the script with the keyboard alone', async ({ open }) => {
  const page = await open();
  await scriptState(page, 'running');
  await page.keyboard.press('Control+Shift+X');
  await scriptState(page, 'stopped');
});

test('shows what is wrong with a script and leads there', async ({ open }) => {
  const page = await open();
  await scriptState(page, 'running');
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  await scriptState(page, 'stopped');
  await page.getByRole('button', { name: 'Edit' }).click();
  await page.getByLabel('Script text').fill(`${'// above\n'.repeat(40)}m = mission {\n  takeOf here\n}\n${'// below\n'.repeat(40)}`);
  await page.locator('#script').getByRole('button', { name: 'Start' }).click();
  await page.getByText('did you mean takeOff?').click();
  const selected = await page.evaluate(() => {
    const editor = document.activeElement;
    return editor.value.slice(editor.selectionStart, editor.selectionEnd);
  });
  assert.equal(selected, 'takeOf');
  const { scrollTop, clientHeight, scrollHeight } = await page.evaluate(() => {
    const { scrollTop, clientHeight, scrollHeight } = document.activeElement;
    return { scrollTop, clientHeight, scrollHeight };
  });
  const top = (scrollHeight / 84) * 41; // of its line
  assert.ok(scrollTop <= top && top < scrollTop + clientHeight, 'the mistake is in sight');
  await page.getByRole('button', { name: 'Discard' }).click();
  await page.locator('#script li', { hasText: 'north = mission' }).waitFor();
});

test('opens a script of the station and starts it', async ({ open }) => {
  const page = await open();
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  await scriptState(page, 'stopped');
  await page.getByLabel('Open a script').selectOption('listing2.dolphin');
  // The text that is read only has the same name until the other has come.
  assert.match(await page.getByRole('textbox', { name: 'Script text' }).inputValue(), /pick/);
  await page.locator('#script').getByRole('button', { name: 'Start' }).click();
  await scriptState(page, 'running');
  await page.locator('header .name', { hasText: 'listing2.dolphin' }).waitFor();
});

test('has some lines of the log in sight at once', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await live(page);
  await openPanel(page, 'Log');
  const log = await page.locator('#log .lines').boundingBox();
  assert.ok(log.height > 80, `only ${log.height} px`);
});
