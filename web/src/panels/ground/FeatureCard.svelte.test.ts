import { render, screen, waitFor, within } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { beforeEach, expect, it, vi } from 'vitest';
import { followFeatures } from '../../layers/found/map_features';
import { TestStation } from '../../testing/station';
import FeatureCard from './FeatureCard.svelte';
import FindOnMap from './FindOnMap.svelte';

beforeEach(() => {
  let made = 0;
  URL.createObjectURL = () => `blob:${(made += 1)}`;
  URL.revokeObjectURL = () => {};
});

const DOOR = {
  type: 'Feature',
  id: 'door 221',
  geometry: { type: 'Point', coordinates: [8.5, 47.4] },
  properties: { id: 'door 221', site: 'demo', floor: '1', kind: 'door', name: '221', text: 'Dr Lark\nRoom 221', picture: 'aa', confidence: 0.91, writer: 'robot 1', at: '2026-11-22T08:00:00Z' }, // prettier-ignore
};
const PICTURE = {
  type: 'Feature',
  id: 'p1',
  geometry: { type: 'Polygon', coordinates: [[[8.5, 47.4], [8.501, 47.4], [8.501, 47.401], [8.5, 47.401], [8.5, 47.4]]] }, // prettier-ignore
  properties: { id: 'p1', site: 'demo', floor: '', image: 'bb', thumbnail: 'cc', taken_at: '2026-11-22T08:00:00Z', vehicle: '3', up_m: 20, camera_x_m: 0, camera_y_m: 0, camera_qx: 1, camera_qy: 0, camera_qz: 0, camera_qw: 0, writer: 'drone 3', at: '2026-11-22T08:00:01Z' }, // prettier-ignore
};

function stationWith(layer: 'points_of_interest' | 'pictures', feature: unknown): TestStation {
  const station = TestStation.live();
  followFeatures(station.stores.feeds, layer);
  station.tell(
    { type: 'sites', feed: 'map.sites', revision: 1, whole: true, sites: [{ id: 'demo', anchor: { lat_deg: 47.4, lon_deg: 8.5, alt_m: 0 }, floors: [{ id: '1', name: 'First floor', up_m: 3 }] }] } as never, // prettier-ignore
    { type: 'features', feed: `map.${layer}`, revision: 1, whole: true, layer, full: true, features: [feature] } as never,
  );
  return station;
}

it('shows the picture and the text of a point of interest, where it is, and who told of it', async () => {
  const station = stationWith('points_of_interest', DOOR);
  station.files.set('/api/v1/blobs/aa', new Response('picture'));
  render(FeatureCard, { props: { layer: 'points_of_interest', id: 'door 221', onclose: () => {} }, context: station.context });
  const card = screen.getByRole('article', { name: '221' });
  expect(within(card).getByText(/Dr Lark/)).toBeVisible();
  expect(within(card).getByText('91 %')).toBeVisible();
  expect(within(card).getByText(/^robot 1,/)).toBeVisible();
  expect(within(card).getByText('demo, First floor')).toBeVisible();
  expect(within(card).getByText(/47\.40000° N/)).toBeVisible();
  await userEvent.click(await within(card).findByRole('button', { name: 'Enlarge: 221, as it was seen' }));
  const large = screen.getByRole('dialog', { name: '221, as it was seen' });
  await userEvent.click(within(large).getByRole('button', { name: 'Close' }));
  expect(large).not.toHaveAttribute('open');
});

it('shows the small picture until the whole one is there', async () => {
  const station = stationWith('pictures', PICTURE);
  let come: (answer: Response) => void = () => {};
  const whole = new Promise<Response>((resolve) => (come = resolve));
  vi.spyOn(station.stores.session, 'ask').mockImplementation((address) =>
    address.endsWith('/bb') ? whole : Promise.resolve(new Response('small')),
  );
  render(FeatureCard, { props: { layer: 'pictures', id: 'p1', onclose: () => {} }, context: station.context });
  const small = await screen.findByRole('button', { name: /^Enlarge/ });
  expect(small).toHaveAttribute('aria-busy', 'true');
  const before = within(small).getByRole('img').getAttribute('src');
  come(new Response('whole'));
  await waitFor(() => expect(small).toHaveAttribute('aria-busy', 'false'));
  expect(within(small).getByRole('img').getAttribute('src')).not.toBe(before);
  expect(screen.getByText('straight down, its upper edge north (000°)')).toBeVisible();
  expect(screen.getByText(/by vehicle 3$/)).toBeVisible();
  expect(screen.getByText('20 m above the site')).toBeVisible();
});

it('says that a picture is not there any more', async () => {
  const station = stationWith('pictures', PICTURE);
  station.files.set('/api/v1/blobs/bb', new Response('', { status: 404 }));
  render(FeatureCard, { props: { layer: 'pictures', id: 'p1', onclose: () => {} }, context: station.context });
  await screen.findByText('This picture is not in the store any more.');
});

it('is reached without a mouse: found by its words', async () => {
  const station = stationWith('points_of_interest', DOOR);
  const onfind = vi.fn();
  render(FindOnMap, { props: { onfind }, context: station.context });
  await userEvent.type(screen.getByRole('searchbox', { name: 'Find on the map' }), 'lark');
  expect(screen.getByRole('status')).toHaveTextContent('1 found');
  await userEvent.tab();
  await userEvent.keyboard('{Enter}');
  expect(onfind).toHaveBeenCalledWith({ layer: 'points_of_interest', id: 'door 221' });
  await userEvent.clear(screen.getByRole('searchbox'));
  await userEvent.type(screen.getByRole('searchbox'), 'nobody');
  expect(screen.getByText('Nothing on the map is called so.')).toBeVisible();
});
