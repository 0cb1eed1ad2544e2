// Commands to vehicles, and who may give them.
import assert from 'node:assert/strict';
import { test } from './fixtures.js';
import { hold, row } from './page.js';

test('commands several vehicles and shows what each made of it', async ({ open }) => {
  const page = await open();
  await row(page, 'link lost').waitFor();
  await row(page, 'copter 2').click();
  await row(page, 'plane 3').click({ modifiers: ['Shift'] });
  await row(page, 'rover 5').click({ modifiers: ['Shift'] });
  const arm = page.locator('#command').getByRole('button', { name: 'Arm', exact: true });
  await arm.click();
  assert.equal(await page.locator('#command details').count(), 0, 'a short click commands nothing');
  await hold(page, arm);
  const outcome = (name) => page.locator('#command details tr', { hasText: name });
  await outcome('copter 2').getByText('confirmed').waitFor();
  assert.match(await outcome('plane 3').innerText(), /refused[\s\S]*Throttle too high/);
  await outcome('rover 5').getByText('expired').waitFor();
  await page.locator('#command summary', { hasText: '1 of 3 confirmed, 2 failed' }).waitFor();
});

test('confirms with the keyboard, and stops without confirmation', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  await page.locator('#command').getByRole('button', { name: 'Take off' }).focus();
  await page.keyboard.down('Enter');
  await page.locator('#command summary', { hasText: 'Take off, 10 m' }).waitFor();
  await page.keyboard.up('Enter');
  await page.locator('#command').getByRole('button', { name: 'Hold' }).click();
  await page.locator('#command details[open] tr', { hasText: 'copter 2' }).getByText('confirmed').waitFor();
});

test('takes nobody off without a height', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 2').click();
  const takeOff = page.locator('#command').getByRole('button', { name: 'Take off' });
  const height = page.getByLabel('Height to take off to');
  for (const none of ['', '0', '-5']) {
    await height.fill(none);
    assert.ok(await takeOff.isDisabled(), `"${none}" is no height`);
    await page.getByText('To take off, give a height').waitFor();
  }
  await height.fill('20');
  await hold(page, takeOff);
  await page.locator('#command .headline', { hasText: /Take off, 20 m: under way, at \d+ of 20 m/ }).waitFor();
  await page.locator('#command .headline', { hasText: 'Take off, 20 m: reached' }).waitFor();
});

for (const size of [
  { width: 1440, height: 900 },
  { width: 1280, height: 800 },
  { width: 1024, height: 768 },
  { width: 390, height: 844 },
]) {
  test(`keeps Hold, Land and Return in sight after commands at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await row(page, 'copter 2').waitFor();
    await page.keyboard.press('2');
    const stop = (name) => page.locator('#command').getByRole('button', { name, exact: true });
    const places = async () => Promise.all(['Hold', 'Land', 'Return', 'Disarm'].map((name) => stop(name).boundingBox()));
    const isReachable = (name) =>
      stop(name).evaluate((button) => {
        const { x, y, width, height } = button.getBoundingClientRect();
        return [y + 2, y + height - 2].every((at) => button.contains(document.elementFromPoint(x + width / 2, at)));
      });
    const before = await places();
    for (let i = 0; i < 3; ++i) await stop(i % 2 ? 'Land' : 'Hold').click();
    await page.locator('#command details').nth(2).waitFor();
    await page.locator('#command .rest').evaluate((element) => element.scrollTo(0, element.scrollHeight));
    for (const name of ['Hold', 'Land', 'Return', 'Disarm']) assert.ok(await isReachable(name), `${name} is in sight`);
    assert.deepEqual(
      (await places()).map(({ x, height }) => [x, height]),
      before.map(({ x, height }) => [x, height]),
    );
    assert.equal(
      await page.locator('#selected').evaluate((drawer) => drawer.scrollHeight - drawer.clientHeight),
      0,
      'nothing scrolls but the rest',
    );
  });
}

test('hands a vehicle over to who asks for it', async ({ open }) => {
  const holder = await open();
  await row(holder, 'plane 3').waitFor();
  await holder.keyboard.press('3');
  await hold(holder, holder.locator('#command').getByRole('button', { name: 'Resume' }));
  await holder.getByText('You command plane 3').waitFor();
  const other = await open();
  await row(other, 'plane 3').waitFor();
  await other.keyboard.press('3');
  await other.getByRole('button', { name: 'Ask for it' }).press('Enter');
  await other
    .locator('#command')
    .getByText(/Asked: yours/)
    .waitFor();
  assert.equal(await other.getByRole('button', { name: 'Ask for it' }).count(), 0, 'who has asked sees it');
  await holder.bringToFront();
  await holder
    .getByRole('group', { name: /asks for plane 3/ })
    .getByRole('button', { name: 'Hand over' })
    .press('Enter');
  await other.bringToFront();
  await other.getByText('You command plane 3').waitFor();
});

test('says whose vehicle it takes over', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').click();
  await page.getByText('copter 1 is commanded by script').waitFor();
  await hold(page, page.getByRole('button', { name: 'Take over: Resume' }));
  await page.getByText('You command copter 1').waitFor();
});
