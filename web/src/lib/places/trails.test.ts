import { expect, it } from 'vitest';
import type { Vehicle } from '../fleet';
import { TRAIL_LIMIT, Trails } from './trails';

const at = (id: string, lat_deg: number, lon_deg = 0): Vehicle => ({
  id,
  fields: { position: { lat_deg, lon_deg, alt_m: 0 } },
  heardAt: {},
});

it('adds a point a step away, and none that is too near', () => {
  const trails = new Trails();
  expect(trails.grow([at('1', 60)])).toBe(true);
  expect(trails.grow([at('1', 60, 0.00001)])).toBe(false);
  expect(trails.grow([at('1', 60, 0.0001)])).toBe(true);
  expect(trails.get('1')!.points).toHaveLength(2);
});

it('drops the oldest points, and counts on', () => {
  const trails = new Trails();
  for (let i = 0; i < 2 * TRAIL_LIMIT; ++i) trails.grow([at('1', i * 0.001)]);
  const { first, points } = trails.get('1')!;
  expect(points.length).toBeGreaterThanOrEqual(TRAIL_LIMIT);
  expect(points.length).toBeLessThan(TRAIL_LIMIT * 1.1);
  expect(first + points.length).toBe(2 * TRAIL_LIMIT);
  expect(points[0]!.lat_deg).toBeCloseTo(first * 0.001);
});

it('forgets vehicles that are gone', () => {
  const trails = new Trails();
  trails.grow([at('1', 0), at('2', 0)]);
  expect(trails.grow([at('2', 0)])).toBe(true);
  expect([...trails.entries()].map(([id]) => id)).toEqual(['2']);
});
