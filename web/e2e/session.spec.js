// A station that goes, comes back, or asks for a token.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { drawn, live, row } from './page.js';

test('says that the station is lost, and finds it again', async ({ complaints, open, station, restart }) => {
  complaints.areDue = true;
  const page = await open();
  await live(page);
  await station().stop();
  await page.locator('.banner', { hasText: 'Station lost' }).waitFor();
  await page.waitForFunction(() => /data [1-9]/.test(document.querySelector('.banner').textContent));
  await row(page, 'old data').first().waitFor();
  await restart();
  await live(page);
  await row(page, 'in the air').first().waitFor();
});

for (const size of [
  { width: 1280, height: 800 },
  { width: 390, height: 844 },
]) {
  test(`tells of the lost station beside everything else at ${size.width} px`, async ({ complaints, open, station }) => {
    complaints.areDue = true;
    const page = await open({ size });
    await live(page);
    await station().stop();
    const banner = page.locator('.banner', { hasText: 'Station lost' });
    await banner.waitFor();
    await page.locator('header .phase', { hasText: 'station lost' }).waitFor();
    const box = await banner.boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= size.width);
    const covered = await page.evaluate(() => {
      const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
      const within = document.querySelector('.banner').getBoundingClientRect();
      const panels = [...document.querySelectorAll('.panel, header')].filter((panel) => overlap(panel.getBoundingClientRect(), within));
      const icons = [...document.querySelectorAll('header .icon')]
        .map((icon) => icon.getBoundingClientRect())
        .filter((icon) => icon.width > 0);
      const words = [...document.querySelectorAll('header .phase, header .state')].map((word) => word.getBoundingClientRect());
      return [...panels.map((panel) => panel.id), ...words.filter((word) => icons.some((icon) => overlap(icon, word))).map(() => 'header')];
    });
    assert.deepEqual(covered, []);
    assert.equal(await page.evaluate(() => document.querySelector('header').scrollWidth), size.width);
  });
}

test('asks for the token, tells a wrong one, and goes on with the right one', async ({ complaints, open, station, restart }) => {
  complaints.areDue = true;
  await station().stop();
  await restart('0123456789abcdef');
  const page = await open();
  const dialog = page.getByRole('dialog', { name: 'This station asks for its token' });
  await dialog.getByLabel('Token').fill('wrong-wrong-wrong');
  await dialog.getByRole('button', { name: 'Connect' }).click();
  await dialog.getByText('The station refused the token').waitFor();
  await page.keyboard.press('Escape');
  await dialog.getByLabel('Token').fill('http://127.0.0.1:8080/#token=0123456789abcdef');
  await page.keyboard.press('Enter');
  await live(page);
  await dialog.waitFor({ state: 'hidden' });
  await row(page, 'copter 1').waitFor();
  await page.locator('#script option', { hasText: 'survey.dolphin' }).waitFor({ state: 'attached' });
});

test('takes the token out of the address', async ({ open, station, restart }) => {
  await station().stop();
  await restart('0123456789abcdef');
  const page = await open({ hash: '#token=0123456789abcdef' });
  await live(page);
  assert.ok(!page.url().includes('token'), page.url());
  await page.reload();
  await live(page);
});

test('asks nobody but the station for anything', async ({ open, station }) => {
  const page = await open();
  const foreign = [];
  page.on(
    'request',
    (request) => request.url().startsWith('http') && !request.url().startsWith(station().url) && foreign.push(request.url()),
  );
  await page.reload();
  await row(page, 'copter 1').waitFor();
  await drawn(page, 'copter 1');
  assert.deepEqual(foreign, []);
});
