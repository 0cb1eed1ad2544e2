import { render, screen, waitFor, within } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { flushSync } from 'svelte';
import { beforeEach, expect, it, vi } from 'vitest';
import { followFeatures } from '../../layers/found/map_features';
import { TestStation } from '../../testing/station';
import PlacePlan from './PlacePlan.svelte';
import PlanList from './PlanList.svelte';

const METRE = 1 / 111_319.49;
const SITES = [{ id: 'demo', anchor: { lat_deg: 0, lon_deg: 0, alt_m: 0 }, floors: [{ id: '1', name: 'First floor', up_m: 0 }] }];
const picture = { name: 'office.png', bytes: new Blob(['bytes'], { type: 'image/png' }), media_type: 'image/png', width: 200, height: 100 } as const; // prettier-ignore

let station: TestStation;
let asked: { method: string; address: string; body: unknown }[];

beforeEach(() => {
  URL.createObjectURL = () => 'blob:1';
  URL.revokeObjectURL = () => {};
  vi.stubGlobal('createImageBitmap', () => Promise.reject(new Error('no pictures here')));
  station = TestStation.live();
  void station.stores.floors.sites;
  followFeatures(station.stores.feeds, 'pictures');
  station.tell({ type: 'sites', feed: 'map.sites', revision: 1, whole: true, sites: SITES } as never);
  asked = [];
  vi.spyOn(station.stores.session, 'ask').mockImplementation((address, { method = 'GET', body } = {}) => {
    asked.push({ method, address, body });
    if (address === '/api/v1/blobs') return Promise.resolve(new Response(JSON.stringify({ sha256: 'abcdef12' }), { status: 201 }));
    return Promise.resolve(new Response('{}'));
  });
});

/** As a click there on the map would do. */
function meet(x_m: number, y_m: number): void {
  station.stores.placing.meet({ lon_deg: x_m * METRE, lat_deg: y_m * METRE });
  flushSync();
}
function choose(u: number, v: number): void {
  station.stores.placing.choose(u, v);
  flushSync();
}

it('leads from place to place, tells how well they fit, and lays the picture on its floor', async () => {
  station.stores.placing.begin(picture, 'demo', '1');
  render(PlacePlan, { context: station.context });
  const told = (): string => screen.getByRole('status').textContent.trim();
  expect(told()).toMatch(/2 more\.$/);
  expect(screen.getByRole('button', { name: 'Save' })).toBeDisabled();
  choose(0, 0);
  expect(told()).toMatch(/^Now click the same place on the map/);
  meet(10, 20);
  choose(200, 0);
  meet(30, 20);
  expect(told()).toMatch(/one more would tell/);
  choose(200, 100);
  meet(30.3, 10);
  expect(told()).toMatch(/^It lies on the map, \d+ cm off on average\.$/);
  expect(screen.getByText(/^Place 3, 0\.\d\d m off$/)).toBeVisible();
  await userEvent.click(screen.getByRole('button', { name: 'Remove place 3' }));
  await userEvent.click(screen.getByRole('button', { name: 'Save' }));
  await waitFor(() => expect(station.stores.placing.picture).toBeUndefined());
  const put = asked.find(({ method }) => method === 'PUT')!;
  expect(put.address).toBe('/api/v1/layers/pictures/features/office%20abcdef?writer=operator%201');
  const feature = JSON.parse(put.body as string) as { geometry: { coordinates: number[][][] }; properties: Record<string, unknown> };
  expect(feature.properties).toMatchObject({
    site: 'demo',
    floor: '1',
    image: 'abcdef12',
    taken_at: expect.any(String) as string,
    width_px: 200,
    height_px: 100,
  });
  const metres = feature.geometry.coordinates[0]!.map((corner) => corner.map((degrees) => Math.round(degrees / METRE)));
  expect(metres).toEqual([[10, 20], [30, 20], [30, 10], [10, 10], [10, 20]]); // prettier-ignore
});

it('is worked by keys alone', async () => {
  station.stores.placing.begin(picture, 'demo', '1');
  render(PlacePlan, { context: station.context });
  const sheet = screen.getByRole('application');
  vi.spyOn(sheet, 'getBoundingClientRect').mockReturnValue({ left: 0, top: 0, width: 400, height: 200 } as DOMRect);
  sheet.focus();
  await userEvent.keyboard('{ArrowRight}{Shift>}{ArrowUp}{/Shift}{Enter}');
  expect(station.stores.placing.waiting).toEqual({ u: 101, v: 40 });
});

it('says what is wrong with places, and keeps the picture when the station refuses', async () => {
  station.stores.placing.begin(picture, 'demo', '1');
  render(PlacePlan, { context: station.context });
  for (const at of [0, 1]) {
    choose(50 + at, 50);
    meet(at, at);
  }
  expect(screen.getByRole('status')).toHaveTextContent('It cannot be laid there: the points lie too near to each other in the picture.');
  choose(150, 50);
  meet(20, 20);
  vi.spyOn(station.stores.session, 'ask').mockResolvedValue(new Response(JSON.stringify({ detail: 'There is no room.' }), { status: 507 }));
  await userEvent.click(screen.getByRole('button', { name: 'Save' }));
  await screen.findByText('There is no room.');
  expect(station.stores.placing.picture).toBe(picture);
  await userEvent.click(screen.getByRole('button', { name: 'Cancel' }));
  expect(station.stores.placing.picture).toBeUndefined();
});

it('lists what was laid there, to adjust it and to take it away, and no pictures of vehicles', async () => {
  const ring = [[0, 0], [20, 0], [20, -10], [0, -10], [0, 0]].map((corner) => corner.map((one) => one * METRE)); // prettier-ignore
  const plan = { type: 'Feature', id: 'office', geometry: { type: 'Polygon', coordinates: [ring] }, properties: { site: 'demo', floor: '1', image: 'aa', taken_at: '2026-11-01T00:00:00Z', media_type: 'image/png', width_px: 200, height_px: 100, writer: 'operator 1' } }; // prettier-ignore
  const taken = { ...plan, id: 'seen', properties: { ...plan.properties, vehicle: '3' } };
  station.tell({
    type: 'features',
    feed: 'map.pictures',
    revision: 1,
    whole: true,
    layer: 'pictures',
    full: true,
    features: [plan, taken],
  } as never);
  render(PlanList, { context: station.context });
  render(PlacePlan, { context: station.context });
  const list = screen.getByRole('region', { name: 'Floor plans' });
  expect(within(list).queryByText('seen')).toBeNull();
  await userEvent.click(within(list).getByRole('button', { name: 'Adjust office' }));
  await screen.findByText(/^It lies on the map, 1 cm off/);
  expect(screen.getByRole('radio', { name: /as it is drawn/ })).toBeChecked();
  choose(100, 50);
  meet(12, -5);
  await userEvent.click(screen.getByRole('button', { name: 'Save' }));
  await waitFor(() =>
    expect(asked.at(-1)).toMatchObject({ method: 'PUT', address: expect.stringContaining('/features/office?') as string }),
  );
  expect(asked.at(-1)!.body as string, 'a picture does not change').toContain('"taken_at":"2026-11-01T00:00:00Z"');
  expect(
    asked.some(({ method }) => method === 'POST'),
    'the picture is in the store already',
  ).toBe(false);
  await userEvent.click(within(list).getByRole('button', { name: 'Remove office' }));
  await userEvent.click(within(list).getByRole('button', { name: 'Really remove office' }));
  expect(asked.at(-1)).toMatchObject({ method: 'DELETE', address: '/api/v1/layers/pictures/features/office' });
});
