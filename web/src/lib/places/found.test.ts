import { expect, it } from 'vitest';
import type { MapFeature } from '../../layers/found/map_features';
import { extentOf, extentOfAll, nameOf, poseOf, search } from './found';

const feature = (id: string, properties: Record<string, unknown> = {}, geometry: MapFeature['geometry'] = { type: 'Point', coordinates: [8, 47] }): MapFeature => ({ type: 'Feature', id, geometry, properties }); // prettier-ignore

it('is called by its name, its kind, its id', () => {
  expect(nameOf(feature('a', { name: '221', kind: 'door' }))).toBe('221');
  expect(nameOf(feature('a', { name: '', kind: 'door' }))).toBe('door');
  expect(nameOf(feature('a', { name: 7 }))).toBe('a');
});

it('is looked for by all words, in the order in which people count', () => {
  const all = [
    feature('d', { name: '10', kind: 'door' }),
    feature('e', { name: '9', kind: 'door' }),
    feature('f', { name: 'fire', text: 'exit' }),
  ];
  expect(search(all, 'DOOR').map(nameOf)).toEqual(['9', '10']);
  expect(search(all, 'door 1').map(nameOf)).toEqual(['10']);
  expect(search(all, ' ')).toHaveLength(3);
  expect(search(all, 'exit').map(nameOf)).toEqual(['fire']);
});

it('has an extent that is never a mere point', () => {
  const wall = feature('w', {}, { type: 'LineString', coordinates: [[8, 47], [8.001, 47.001]] }); // prettier-ignore
  expect(extentOf(wall)).toMatchObject({ west: 8, north: 47.001 });
  const { west, east } = extentOf(feature('p'))!;
  expect(east).toBeGreaterThan(west);
  expect(extentOf(feature('n', {}, { type: 'Point', coordinates: [] }))).toBeUndefined();
});

it('has an extent together with others, whatever of them has no place', () => {
  const at = (lon: number): MapFeature => feature(`p${lon}`, {}, { type: 'Point', coordinates: [lon, 47] });
  const nowhere = feature('n', {}, { type: 'Point', coordinates: [] });
  const { west, east } = extentOfAll([nowhere, at(8), at(8.5), nowhere])!;
  expect(west).toBeCloseTo(8, 3);
  expect(east).toBeCloseTo(8.5, 3);
  expect(extentOfAll([nowhere])).toBeUndefined();
});

it('tells from where a picture was taken, by its point or by its site', () => {
  const anchor = { lat_deg: 47, lon_deg: 8, alt_m: 400 };
  expect(poseOf(feature('p', { up_m: 12 }), anchor)).toMatchObject({ from: { lat_deg: 47, lon_deg: 8 }, up_m: 12 });
  const square = { type: 'Polygon', coordinates: [[[8, 47], [8.1, 47], [8.1, 47.1], [8, 47]]] } as const; // prettier-ignore
  const seen = feature(
    'q',
    { camera_x_m: 0, camera_y_m: 111.31949, camera_qx: 1, camera_qy: 0, camera_qz: 0, camera_qw: 0 },
    square as never,
  );
  expect(poseOf(seen, anchor).from?.lat_deg).toBeCloseTo(47.001, 6);
  expect(poseOf(seen, anchor).axis?.isPlumb).toBe(true);
  expect(poseOf(seen, undefined).from).toBeUndefined();
});
