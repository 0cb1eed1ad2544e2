import { expect, it } from 'vitest';
import { ellipseOf, sketchesOf } from './robot_sketch';

const METRES_PER_DEGREE = 111_319.49;
const spread = { major_m: 0.5, minor_m: 0.1, axis_rad: Math.PI / 2 };

it('reads what robots intend', () => {
  const told = { id: 'robot1', coverage: 0.5, way: [[-8, 41]], frontiers: [[-8.1, 41.1]], spread };
  expect(sketchesOf({ type: 'robots', robots: [told] })).toEqual([{ id: 'robot1', way: [[-8, 41]], frontiers: [[-8.1, 41.1]], spread }]);
});

it('leaves out what cannot be', () => {
  const told = { id: 'robot1', way: [[-8, 41], [-8, 141], ['x', 41], [1], null], frontiers: 'none', spread: { major_m: Infinity } };
  expect(sketchesOf({ robots: [told, { way: [] }, null, 7] })).toEqual([
    { id: 'robot1', way: [[-8, 41]], frontiers: [], spread: undefined },
  ]);
  expect(sketchesOf(undefined)).toEqual([]);
  expect(sketchesOf({ robots: {} })).toEqual([]);
});

it('draws two standard deviations along the axes of the spread', () => {
  const around = ellipseOf(spread, { lat_deg: 41, lon_deg: -8, alt_m: 0 });
  const norths = around.map(([, lat]) => (lat - 41) * METRES_PER_DEGREE);
  const easts = around.map(([lon]) => (lon + 8) * METRES_PER_DEGREE * Math.cos((41 * Math.PI) / 180));
  expect(Math.max(...norths)).toBeCloseTo(1);
  expect(Math.max(...easts)).toBeCloseTo(0.2);
});
