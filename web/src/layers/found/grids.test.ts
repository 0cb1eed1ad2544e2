import { describe, expect, it } from 'vitest';
import type { Frame } from '../../connection/frame';
import { take, type MapGrid } from './grids';

const news = (revision: number, changed: number[][], full = false): Frame =>
  ({
    whole: full,
    content: {
      type: 'grids',
      grids: [{ site: 's', floor: '', name: 'g', bounds: [0, 0, 1, 1], pictures: `/p?revision=${revision}`, tiling: {}, changed, full }],
    },
  }) as unknown as Frame;

const only = (grids: ReadonlyMap<string, MapGrid>): MapGrid => [...grids.values()][0]!;

describe('news of grids', () => {
  it('add up until they are drawn', () => {
    let grids = take(new Map(), news(1, [], true));
    grids = take(grids, news(2, [[1, 1]]));
    expect(only(grids)).toMatchObject({ isNew: true, pictures: '/p?revision=2' });
    only(grids).isDrawn = true;
    grids = take(grids, news(3, [[2, 2]]));
    grids = take(grids, news(4, [[3, 3]]));
    expect(only(grids)).toMatchObject({ isNew: false, changed: [[2, 2], [3, 3]] }); // prettier-ignore
  });
});
