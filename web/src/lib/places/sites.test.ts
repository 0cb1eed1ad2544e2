import { expect, it } from 'vitest';
import { mergeUpdates } from '../fleet';
import { headingOf, siteToMap } from './sites';

const anchor = { lat_deg: 41, lon_deg: -8, alt_m: 100 };
const pose = { site: 'office', x_m: 30, y_m: 40, z_m: 2, yaw_rad: 0 };
const anchorOf = (site: string) => (site === 'office' ? anchor : undefined);

it('puts a place of a site on the map', () => {
  const { lat_deg, lon_deg, alt_m } = siteToMap(pose, anchor);
  expect((lat_deg - 41) * 111_319.49).toBeCloseTo(40);
  expect((lon_deg + 8) * 111_319.49 * Math.cos((41 * Math.PI) / 180)).toBeCloseTo(30);
  expect(alt_m).toBe(102);
});

it('turns what looks east, and what looks west', () => {
  expect(headingOf(0)).toBeCloseTo(Math.PI / 2);
  expect(headingOf(Math.PI)).toBeCloseTo((3 * Math.PI) / 2);
});

it('gives a robot that knows its place in a site alone a place on the map, and moves it', () => {
  const first = mergeUpdates(new Map(), [{ id: 'r', site_pose: pose }], true, 0, anchorOf).get('r')!;
  expect(first.fields.position).toEqual(siteToMap(pose, anchor));
  const moved = mergeUpdates(new Map([['r', first]]), [{ id: 'r', site_pose: { ...pose, x_m: 60 } }], false, 1, anchorOf).get('r')!;
  expect(moved.fields.position!.lon_deg).toBeGreaterThan(first.fields.position!.lon_deg);
  expect(
    mergeUpdates(new Map(), [{ id: 'r', site_pose: { ...pose, site: 'barn' } }], true, 0, anchorOf).get('r')!.fields.position,
  ).toBeUndefined();
});

it('leaves who has a position of its own where it says that it is', () => {
  const position = { lat_deg: 1, lon_deg: 2, alt_m: 3 };
  const known = mergeUpdates(new Map(), [{ id: 'r', position, site_pose: pose }], true, 0, anchorOf);
  expect(known.get('r')!.fields.position).toEqual(position);
  expect(mergeUpdates(known, [{ id: 'r', site_pose: { ...pose, x_m: 9 } }], false, 1, anchorOf).get('r')!.fields.position).toEqual(
    position,
  );
});
