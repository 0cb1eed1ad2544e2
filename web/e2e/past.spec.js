// Looking back: what has changed between two moments, and a store that is opened to be looked back in.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { test } from './fixtures.js';

async function put(station, path, body) {
  const answer = await fetch(new URL(path, station.url), {
    method: 'PUT',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
  });
  assert.ok(answer.ok, `${path}: ${await answer.text()}`);
}

const door = (name) => ({
  type: 'Feature',
  geometry: { type: 'Point', coordinates: [8.5458, 47.3978] },
  properties: { site: 'yard', kind: 'door', name },
});

/** Until what has been put on the map so far is in the past. */
async function recorded(station) {
  const newest = async () => (await (await fetch(new URL('/api/v1/history', station.url))).json()).sessions[0]?.ended_ms ?? 0;
  await expect.poll(newest, { timeout: 30_000 }).toBeGreaterThan(0);
  const now = await newest();
  await expect.poll(newest, { timeout: 30_000 }).toBeGreaterThan(now + 1500);
}

test('shows what has changed between two moments, on the map and as a list', async ({ open, fleet }) => {
  await put(fleet, '/api/v1/sites/yard', { anchor: { lat_deg: 47.3977, lon_deg: 8.5456, alt_m: 488 } });
  await put(fleet, '/api/v1/layers/points_of_interest/features/before', door('220'));
  await put(fleet, '/api/v1/layers/points_of_interest/features/changed', door('221'));
  await recorded(fleet);
  const page = await open({ url: fleet.url, isSharp: true });
  await page.getByRole('button', { name: 'Look back' }).click();
  const bar = page.getByRole('region', { name: 'Looking back' });
  await bar.getByRole('slider', { name: 'Moment' }).press('End');
  await bar.getByRole('button', { name: 'Compare' }).click();
  await put(fleet, '/api/v1/layers/points_of_interest/features/changed', door('222'));
  await put(fleet, '/api/v1/layers/points_of_interest/features/new', door('223'));
  await recorded(fleet);
  await bar.getByRole('button', { name: 'With now' }).click();
  const panel = page.getByRole('complementary', { name: 'What has changed' });
  await panel.getByText('1 added').waitFor();
  await panel.getByText('1 changed').waitFor();
  await panel.getByText('0 removed').waitFor();
  await panel.getByText('name: 221 → 222').waitFor();
  const scale = page.locator('.maplibregl-ctrl-scale');
  const before = await scale.innerText();
  await panel.getByRole('button', { name: /added point of interest 223/ }).click();
  await expect(scale).not.toHaveText(before);
  await bar.getByRole('slider', { name: 'Compare with' }).press('End');
  await panel.getByText('Nothing has changed.').waitFor();
  await panel.getByRole('button', { name: 'End the comparison' }).click();
  await expect(panel).toBeHidden();
});
