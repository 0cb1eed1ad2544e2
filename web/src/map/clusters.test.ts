import { describe, expect, it } from 'vitest';
import { clustered } from './clusters';

const dense = Array.from({ length: 250 }, (_, index) => ({
  id: index,
  at: [8.5 + (index % 16) * 1e-4, 47.4 + Math.floor(index / 16) * 1e-4] as [number, number],
  mustBeSeen: index === 17,
}));
const idsOf = ({ alone, clusters }: ReturnType<typeof clustered<(typeof dense)[number]>>) =>
  [...alone, ...clusters.flatMap(({ members }) => members)].map(({ id }) => id).sort((a, b) => a - b);

describe('clusters', () => {
  it('have every vehicle once', () => {
    for (const zoom of [2, 12, 15, 17, 20]) expect(idsOf(clustered(dense, zoom))).toEqual(dense.map(({ id }) => id));
  });
  it('are few from afar, and none from near', () => {
    const far = clustered(dense, 10);
    expect(far.clusters.length).toBeLessThan(5);
    expect(far.alone.map(({ id }) => id)).toEqual([17]);
    expect(clustered(dense, 20).clusters).toEqual([]);
  });
  it('are not made of a few', () => expect(clustered(dense.slice(0, 5), 2).clusters).toEqual([]));
});
