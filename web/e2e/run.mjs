// Drives the app in a real browser against a real station over HTTP and WebSocket. usage: node e2e/run.mjs [WORD]
// runs the tests whose name holds WORD; needs web/dist (npm run build) and the target station_demo.
import assert from 'node:assert/strict';
import { startBrowser, startStation } from './harness.mjs';
import { addAlarmTests } from './alarms.mjs';
import { addEmergencyTests } from './emergency.mjs';
import { addGoToTests } from './go_to.mjs';
import { addHoldTests } from './hold.mjs';
import { addParameterTests } from './parameters.mjs';

const tests = [];
const test = (name, run, options) => tests.push({ name, run, options });

const row = (page, name) => page.locator('#vehicles tbody tr', { hasText: name });
const scriptState = (page, state) => page.locator('#script .chip', { hasText: state }).waitFor();
const hold = async (page, button) => {
  await page.bringToFront();
  await button.hover();
  await page.mouse.down();
  await page.waitForTimeout(1000);
  await page.mouse.up();
};
const live = (page) => page.locator('header .phase', { hasText: 'live' }).waitFor();

test('shows every vehicle, and they move', async ({ open }) => {
  const page = await open();
  await row(page, 'copter 1').waitFor();
  assert.equal(await page.locator('#vehicles tbody tr').count(), 5);
  assert.match(await row(page, 'copter 1').innerText(), /AUTO[\s\S]*20 m[\s\S]*8\.0 m\/s[\s\S]*%/);
  const marker = page.locator('.vehicle[aria-label^="copter 1"]');
  const before = await marker.boundingBox();
  await page.waitForFunction(
    ([x, y]) => {
      const now = document.querySelector('.vehicle[aria-label^="copter 1"]').getBoundingClientRect();
      return Math.hypot(now.x - x, now.y - y) > 5;
    },
    [before.x, before.y],
  );
});

for (const size of [
  { width: 1280, height: 800 },
  { width: 900, height: 800 },
  { width: 390, height: 844 },
]) {
  test(`tells of the selected vehicle's health at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await row(page, 'copter 1').click();
    const details = page.locator('#vehicles .details');
    await details
      .getByText(/about|\d–\d+ min/)
      .first()
      .waitFor();
    const text = await details.innerText();
    for (const part of [/RTK fixed, 14 satellites/, /compass 0\.6/, /Maker M1, standby/, /90° down, towards 046°/, /EKF3 compass variance/])
      assert.match(text, part);
    assert.doesNotMatch(await details.locator('dd', { hasText: 'active' }).first().innerText(), /ago/);
    await details
      .locator('dd', { hasText: 'Maker M1' })
      .getByText(/1\d s ago/)
      .waitFor();
    const panel = await page.locator('#vehicles').boundingBox();
    const inside = await details.boundingBox();
    assert.ok(inside.x >= panel.x && inside.x + inside.width <= panel.x + panel.width + 1, 'the details fit the panel');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), size.width);
    await page.keyboard.press('Escape');
    await details.waitFor({ state: 'detached' });
  });
}

test('keeps the vehicle table whole, beside a long task tree and with long modes and links', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await page.locator('#tasks li.running', { hasText: 'north' }).first().waitFor();
  const cut = () =>
    page.evaluate(() => {
      const body = document.querySelector('#vehicles .body');
      return { high: body.scrollHeight - body.clientHeight, wide: body.scrollWidth - body.clientWidth };
    });
  assert.ok((await cut()).high <= 1, 'every vehicle is in sight');
  assert.ok((await row(page, 'copter 1').boundingBox()).height < 60, 'who commands it stands beside its state where there is room');
  await page.evaluate(() => {
    for (const mode of document.querySelectorAll('#vehicles .mode .part')) mode.textContent = 'STABILIZE';
    for (const link of document.querySelectorAll('#vehicles .age .sub')) link.innerHTML = '12 % lost';
  });
  const { wide } = await cut();
  assert.ok(wide <= 0, `${wide} px are beyond the edge`);
});

test('tells a lost vehicle by word, sign and age', async ({ open }) => {
  const page = await open();
  await row(page, 'link lost').waitFor();
  assert.match(await row(page, 'rover 5').innerText(), /\? link lost/);
  await page.waitForFunction(() => parseFloat(document.querySelector('#vehicles tr.lost td.age').textContent) > 2);
});

test('shows the task tree and the line that runs', async ({ open }) => {
  const page = await open();
  await page.locator('#tasks li.running', { hasText: 'north' }).first().waitFor();
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
    if (size.width < 900) await page.getByRole('button', { name: 'Command', exact: true }).click();
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
      await page.locator('#command .body').evaluate((body) => body.scrollHeight - body.clientHeight),
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

addAlarmTests(test, row);
addEmergencyTests(test, row, hold);
addGoToTests(test, row, hold);
addHoldTests(test, row);
addParameterTests(test, row);

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

test(
  'says that the station is lost, and finds it again',
  async ({ open, station, restart }) => {
    const page = await open();
    await live(page);
    await station().stop();
    await page.locator('.banner', { hasText: 'Station lost' }).waitFor();
    await page.waitForFunction(() => /data [1-9]/.test(document.querySelector('.banner').textContent));
    await row(page, 'old data').first().waitFor();
    await restart();
    await live(page);
    await row(page, 'in the air').first().waitFor();
  },
  { complaintsAllowed: true },
);

for (const size of [
  { width: 1280, height: 800 },
  { width: 390, height: 844 },
]) {
  test(
    `tells of the lost station beside everything else at ${size.width} px`,
    async ({ open, station }) => {
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
        const panels = [...document.querySelectorAll('.panel:not([hidden]), header')].filter((panel) =>
          overlap(panel.getBoundingClientRect(), within),
        );
        const icons = [...document.querySelectorAll('header .icon')]
          .map((icon) => icon.getBoundingClientRect())
          .filter((icon) => icon.width > 0);
        const words = [...document.querySelectorAll('header .phase, header .state')].map((word) => word.getBoundingClientRect());
        return [
          ...panels.map((panel) => panel.id),
          ...words.filter((word) => icons.some((icon) => overlap(icon, word))).map(() => 'header'),
        ];
      });
      assert.deepEqual(covered, []);
      assert.equal(await page.evaluate(() => document.querySelector('header').scrollWidth), size.width);
    },
    { complaintsAllowed: true },
  );
}

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

/** Every vehicle's marker lies on the map beside the panels, not below them. */
const inSight = (page) =>
  page.waitForFunction(() => {
    const panels = [...document.querySelectorAll('.panel:not([hidden]), header, nav.tabs')].map((panel) => panel.getBoundingClientRect());
    const markers = [...document.querySelectorAll('.vehicle')].map((marker) => marker.getBoundingClientRect());
    const isCovered = (x, y) => panels.some((panel) => x > panel.left && x < panel.right && y > panel.top && y < panel.bottom);
    return markers.length === 5 && markers.every(({ x, y }) => x > 0 && y > 0 && x + 44 < innerWidth && !isCovered(x + 22, y + 22));
  });

for (const size of [
  { width: 1280, height: 800 },
  { width: 1920, height: 1080 },
  { width: 390, height: 844 },
]) {
  test(`has every vehicle in sight from the start at ${size.width} px`, async ({ open }) => {
    const page = await open({ size });
    await inSight(page);
  });
}

test('leaves the view alone once the operator has moved it, until F', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await inSight(page);
  await page.mouse.move(640, 600);
  await page.mouse.down();
  await page.mouse.move(640, 250, { steps: 5 });
  await page.mouse.up();
  const scale = page.locator('.maplibregl-ctrl-scale');
  await page.keyboard.press('-');
  await page.keyboard.press('-');
  await page.keyboard.press('-');
  await page.waitForTimeout(400);
  const zoomedOut = await scale.textContent();
  await page.waitForTimeout(1500);
  assert.equal(await scale.textContent(), zoomedOut);
  await page.keyboard.press('f');
  await page.waitForFunction((before) => document.querySelector('.maplibregl-ctrl-scale').textContent !== before, zoomedOut);
  await inSight(page);
});

test('shows no label over another', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await inSight(page);
  const onOneSpot = () =>
    page.evaluate(() => {
      const boxes = [...document.querySelectorAll('.vehicle')].map((marker) => marker.getBoundingClientRect());
      return boxes.every(({ x, y }) => Math.hypot(x - boxes[0].x, y - boxes[0].y) < 20);
    });
  while (!(await onOneSpot())) await page.keyboard.press('-'); // a press during a zoom counts from where the zoom is
  await page.waitForFunction(() => {
    const boxes = [...document.querySelectorAll('.vehicle .label')].map((label) => label.getBoundingClientRect());
    return boxes.every((a, i) =>
      boxes.slice(i + 1).every((b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 0.5 || b.bottom <= a.top + 0.5),
    );
  });
});

test('opens a script of the station and starts it', async ({ open }) => {
  const page = await open();
  await page.getByRole('button', { name: 'STOP', exact: true }).click();
  await scriptState(page, 'stopped');
  await page.getByLabel('Open a script').selectOption('listing2.dolphin');
  await page.getByLabel('Script text').waitFor();
  assert.match(await page.getByLabel('Script text').inputValue(), /pick/);
  await page.locator('#script').getByRole('button', { name: 'Start' }).click();
  await scriptState(page, 'running');
  await page.locator('header .name', { hasText: 'listing2.dolphin' }).waitFor();
});

test('keeps some lines of the log in sight, however long the script', async ({ open }) => {
  const page = await open({ size: { width: 1280, height: 800 } });
  await live(page);
  const log = await page.locator('#log .lines').boundingBox();
  assert.ok(log.height > 80, `only ${log.height} px`);
});

test(
  'asks for the token, tells a wrong one, and goes on with the right one',
  async ({ open, station, restart }) => {
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
  },
  { complaintsAllowed: true },
);

test('takes the token out of the address', async ({ open, station, restart }) => {
  await station().stop();
  await restart('0123456789abcdef');
  const page = await open({ hash: '#token=0123456789abcdef' });
  await live(page);
  assert.ok(!page.url().includes('token'), page.url());
  await page.reload();
  await live(page);
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

test('asks nobody but the station for anything', async ({ open, station }) => {
  const page = await open();
  const foreign = [];
  page.on(
    'request',
    (request) => request.url().startsWith('http') && !request.url().startsWith(station().url) && foreign.push(request.url()),
  );
  await page.reload();
  await row(page, 'copter 1').waitFor();
  await page.waitForFunction(() => document.querySelectorAll('.vehicle').length === 5);
  assert.deepEqual(foreign, []);
});

/** Each test has a station and a page of its own; any error in the page fails it, refused resources too. */
async function runTest(browser, { run, options }) {
  let station = await startStation();
  const opened = [];
  try {
    await run({
      station: () => station,
      restart: async (token) => (station = await startStation(station.port, token)),
      open: async (pageOptions) => {
        const it = await browser.open(station.url + (pageOptions?.hash ?? ''), pageOptions);
        it.page.setDefaultTimeout(15_000);
        opened.push(it);
        return it.page;
      },
    });
    if (!options?.complaintsAllowed)
      assert.deepEqual(
        opened.flatMap((it) => it.complaints),
        [],
      );
  } finally {
    for (const { page } of opened) {
      await page.evaluate(() => localStorage.clear()).catch(() => {});
      await page.close();
    }
    await station.stop();
  }
}

const browser = await startBrowser();
let failed = 0;
const chosen = tests.filter(({ name }) => name.includes(process.argv[2] ?? ''));
for (const one of chosen) {
  try {
    await runTest(browser, one);
    console.log(`ok   ${one.name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL ${one.name}\n     ${String(error.stack ?? error).replaceAll('\n', '\n     ')}`);
  }
}
await browser.stop();
console.log(`${chosen.length - failed} passed, ${failed} failed`);
process.exit(failed === 0 && chosen.length > 0 ? 0 : 1);
