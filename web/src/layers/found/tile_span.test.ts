import { describe, expect, it } from 'vitest';
import { tilesWithin, type LonLatBox } from './tile_span';

const world: LonLatBox = [-180, -85, 180, 85];

describe('which tiles a change touches', () => {
  it('is one where it is small', () => {
    // The Porto of the demo at zoom 12, by the formulas of the OpenStreetMap wiki (Slippy map tilenames).
    expect(tilesWithin([-8.5981, 41.178, -8.598, 41.1781], world, [12])).toEqual([{ z: 12, x: 1950, y: 1533 }]);
  });
  it('is none out of sight', () => {
    expect(tilesWithin([1, 1, 2, 2], [3, 3, 4, 4], [5])).toEqual([]);
  });
  it('is bounded', () => {
    expect(tilesWithin(world, world, [10])).toHaveLength(400);
  });
});
