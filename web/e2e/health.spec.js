// A robot's modules, as the program itself tells of them: who is well, a kill and the restart, in both widths.
import assert from 'node:assert/strict';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { axe, violations } from './axe.js';
import { test as base } from './fixtures.js';
import { startFleet } from './harness.mjs';
import { hold, live, openPanel } from './page.js';

const FLAT = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../examples/buildings/flat.toml');

/** The program with a simulated robot beside the copter. */
const test = base.extend({
  robots: async ({}, use) => {
    const robots = await startFleet('copter:1', 1, ['--robot', `sim:${FLAT}`]);
    await use(robots);
    await robots.stop();
  },
});

const vehicleState = (panel, text) => panel.locator('.vehicle', { hasText: text }).waitFor();

test('shows how each module of a robot is', async ({ open, robots }) => {
  const page = await open({ url: robots.url });
  await live(page);
  const panel = await openPanel(page, 'Health');
  await vehicleState(panel, 'may move');
  assert.deepEqual(await panel.getByRole('columnheader').allInnerTexts(), [
    'Module',
    'State',
    'Error and what to do',
    'Memory',
    'CPU',
    'Reports',
    'Last heard',
  ]);
  for (const name of ['SIM sensors', 'CAR carrier', 'MMU mapping', 'PLN planner', 'CM communication'])
    await panel.getByRole('row', { name: new RegExp(`^${name}`) }).waitFor();
  const sensors = panel.getByRole('row', { name: /^SIM/ });
  assert.match(await sensors.innerText(), /\d+ MB\s+\d+ %\s+1?\d \/s\s+0\.\d s/);
  assert.equal(await panel.getByRole('button').count(), 0, 'nothing is to be done');
});

for (const size of [
  { width: 1440, height: 900 },
  { width: 390, height: 844 },
]) {
  test(`lets a robot that was killed go again by the operator at ${size.width} px`, async ({ open, robots }) => {
    const page = await open({ url: robots.url, size });
    await live(page);
    const panel = await openPanel(page, 'Health');
    await vehicleState(panel, 'may move');
    await page.getByRole('button', { name: 'E-STOP' }).click();
    const banner = page.getByRole('region', { name: 'Emergency stop' });
    await banner.waitFor();
    await vehicleState(panel, 'the robot was killed');
    const restart = panel.getByRole('button', { name: 'Restart' });
    assert.ok(await restart.isDisabled(), 'the emergency stop holds');
    await hold(page, banner.getByRole('button', { name: 'Release' }));
    await vehicleState(panel, 'may move');

    const health = await (await fetch(`${robots.url}api/v1/health`)).json();
    assert.equal(health.vehicles[0].needs_restart, false);
    const order = { action: 'disarm', vehicles: ['robot1'] };
    const answer = await fetch(`${robots.url}api/v1/commands`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(order),
    });
    assert.equal(answer.status, 202);
    await vehicleState(panel, 'the robot was killed');
    await page.evaluate(axe);
    assert.deepEqual(await violations(page), []);
    assert.ok((await panel.evaluate((element) => element.scrollWidth - element.clientWidth)) <= 0, 'nothing is beside the panel');
    await hold(page, panel.getByRole('button', { name: /Restart/ }));
    await vehicleState(panel, 'may move');
    await restart.waitFor({ state: 'detached' });
  });
}
