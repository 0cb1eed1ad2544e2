// Alarms, ages, and a station that sends what cannot be.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { test } from './fixtures.js';
import { drawn, moves, placeOnMap, row, selectedRow } from './page.js';

const alarms = (page) => page.getByRole('region', { name: 'Alarms' });

/** The rover that the station loses after some seconds stays silent, so that a slow machine is not too late to see it. */
const staysSilent = (message) => {
  if (message.type === 'vehicles')
    return [
      {
        ...message,
        vehicles: message.vehicles.map((vehicle) => (vehicle.connection === 'lost' ? { ...vehicle, connection: 'ok' } : vehicle)),
      },
    ];
  if (message.type !== 'alarms') return [message];
  return [
    {
      ...message,
      alarms: message.alarms.map((alarm) =>
        alarm.kind === 'lost' ? { ...alarm, kind: 'silent', text: 'rover 5 silent, last known disarmed' } : alarm,
      ),
    },
  ];
};

test('tells of a silent vehicle: in a banner, the list, the map, the tab and to screen readers', async ({ open }) => {
  const page = await open({ station: staysSilent });
  const line = alarms(page).getByRole('listitem').filter({ hasText: 'rover 5 silent' });
  await line.waitFor();
  assert.match(await line.innerText(), /rover 5 silent, last known disarmed\s+[\d.]+ s\s+Acknowledge/);
  await page.getByRole('alert').filter({ hasText: 'rover 5 silent' }).waitFor();
  const told = await row(page, 'rover 5').innerText();
  assert.match(told, /\? silent[\s\S]*last known[\s\S]*loss unknown/);
  assert.doesNotMatch(told, /0 % lost/);
  await drawn(page, 'rover 5');
  assert.match(await page.title(), /^▲ 2 alarms · Lapwing$/);
  await line.getByRole('button', { name: 'rover 5 silent' }).first().click();
  await selectedRow(page, 'rover 5').waitFor();
});

test('keeps an acknowledged alarm in sight quietly, for every viewer, and the others as they are', async ({ open }) => {
  const page = await open();
  const other = await open();
  await alarms(page).getByText('rover 5 lost').waitFor();
  await alarms(page).getByRole('button', { name: 'Acknowledge: copter 2 battery low' }).click();
  for (const viewer of [page, other]) {
    const quiet = viewer.locator('details.quiet');
    await quiet.locator('summary', { hasText: 'copter 2 battery low' }).waitFor();
    assert.equal(await alarms(viewer).getByText('copter 2 battery low').count(), 0);
    await quiet.locator('summary').click();
    await quiet.getByText(/acknowledged by operator \d/).waitFor();
    await alarms(viewer).getByText('rover 5 lost').waitFor();
    assert.match(await viewer.title(), /^▲ 1 alarm ·/);
  }
});

test('sounds and speaks by choice alone', async ({ open }) => {
  let isHeld = true;
  const page = await open({
    station: (message) => [
      message.type === 'alarms' && isHeld ? { ...message, alarms: message.alarms.filter(({ vehicle }) => vehicle !== '5') } : message,
    ],
  });
  await page.evaluate(() => {
    window.heard = [];
    window.speechSynthesis.speak = (words) => window.heard.push(words.text);
    const start = OscillatorNode.prototype.start;
    OscillatorNode.prototype.start = function (at) {
      window.heard.push('tone');
      return start.call(this, at);
    };
  });
  const acknowledge = alarms(page).getByRole('button', { name: 'Acknowledge: copter 2 battery low' });
  await acknowledge.waitFor();
  await row(page, 'link lost').waitFor();
  assert.deepEqual(await page.evaluate(() => window.heard), [], 'nothing unless somebody has chosen it');
  await page.getByRole('button', { name: 'Settings' }).click();
  const settings = page.getByRole('dialog', { name: 'Settings' });
  await settings.getByLabel('Voice').check();
  await page.waitForFunction(() => window.heard.some((words) => words.startsWith('Alarms are spoken')));
  await settings.getByLabel('Sound').check();
  await page.keyboard.press('Escape');
  await page.evaluate(() => (window.heard = []));
  isHeld = false;
  await acknowledge.click(); // the station tells its alarms anew
  await page.waitForFunction(() => window.heard.some((words) => words.startsWith('rover 5 lost')));
  assert.ok((await page.evaluate(() => window.heard)).includes('tone'));
});

test('tells 250 silent vehicles as one', async ({ open }) => {
  const page = await open({
    station: (message) => {
      if (message.type !== 'alarms') return [message];
      const silent = Array.from({ length: 250 }, (_, i) => ({
        number: 1000 + i,
        kind: 'silent',
        severity: 'critical',
        vehicle: String(i + 1),
        text: `copter ${i + 1} silent`,
        raised: '',
        age_s: 3,
      }));
      return [{ ...message, alarms: silent }];
    },
  });
  const lines = alarms(page).getByRole('listitem');
  await lines.filter({ hasText: '250 vehicles silent' }).waitFor();
  assert.equal(await lines.count(), 1);
  assert.match(await page.title(), /^▲ 250 alarms/);
  assert.ok((await alarms(page).boundingBox()).height < 140);
});

test('survives what cannot be, and shows the others as ever', async ({ open }) => {
  let turn = 0;
  const odd = [2_147_483_647, -214.7483648, 1e300, null, 'north', [], {}, 91, true];
  const hostile = () => {
    const value = odd[turn++ % odd.length];
    const position = turn % 2 ? { lat_deg: value, lon_deg: 214.7483647, alt_m: -2_147_484 } : value;
    return [
      {
        type: 'vehicles',
        time_s: turn,
        full: false,
        vehicles: [
          {
            id: '9',
            name: value,
            family: value,
            mode: value,
            position,
            home: position,
            relative_alt_m: value,
            velocity_m_s: { north: value, east: 1e300, down: 0 },
            battery: { remaining: turn % 3 ? -1.28 : value },
            links: [{ name: value, used: true, alive: true }, value],
            mission: value,
            texts: [value],
            components: [value, value],
            control: value,
            heading_rad: value,
            age_s: { heartbeat: value, position: -3 },
          },
        ],
      },
      { type: 'plan', vehicle: '9', path: [position, value, position] },
      {
        type: 'pictures',
        vehicle: '9',
        full: false,
        pictures: [{ number: 1, ...(typeof position === 'object' ? position : {}) }, value],
      },
      {
        type: 'tasks',
        trees: [
          {
            id: 1,
            kind: 'a',
            label: 'x',
            line: 1,
            state: 'running',
            children: [1, 1].map((id) => ({ id, kind: value, label: 'b', line: value, state: 'running' })),
          },
        ],
      },
      { type: 'log', lines: [1, 1].map((seq) => ({ seq, time: value, level: value, source: 'a', text: 'b' })) },
      {
        type: 'commands',
        commands: [1, 1].map((number) => ({
          number,
          action: value,
          by: 'a',
          asked: 'b',
          vehicles: [{ vehicle: '1', state: value }, value],
        })),
      },
      { type: 'alarms', alarms: [{ number: 1, kind: value, severity: value, vehicle: value, text: value }, value] },
      { type: 'script', name: value, state: value, diagnostics: value },
      { type: 'emergency', latched: value, vehicles: value },
      { type: value },
    ];
  };
  const page = await open({ station: (message) => (message.type === 'vehicles' ? [message, ...hostile()] : [message]) });
  await row(page, 'copter 1').waitFor();
  await page.locator('#vehicles [role=option]').nth(5).waitFor(); // the odd one, too
  await moves(page, 'copter 1');
  await drawn(page, 'rover 5');
  assert.equal(await placeOnMap(page, '9'), undefined, 'who has no possible position has no place on the map');
  await page.keyboard.press('6');
  await page.locator('#selected .details').waitFor();
  const all = turn + 2 * odd.length;
  await expect.poll(() => turn, 'each odd value was told').toBeGreaterThan(all);
  for (const part of ['#vehicles', '#selected'])
    assert.doesNotMatch(await page.locator(part).innerText(), /NaN|undefined|-?2.?147|Infinity|-128/);
  await page.keyboard.press('Escape'); // or F shows where the odd one might be
  await page.keyboard.press('f');
  await page.waitForFunction(() => {
    const { x, y } = document.querySelector('.map').placeOf('1');
    const { left, right, top, bottom } = document.querySelector('.map').getBoundingClientRect();
    return x > left && x < right && y > top && y < bottom;
  });
});
