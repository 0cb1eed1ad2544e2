import { describe, expect, it } from 'vitest';
import { Tracks } from './tracks';

const leg = (id: string, from: number, points: unknown, began_at = '2026-11-22T10:00:00Z') => ({
  id,
  vehicle: '1',
  began_at,
  from,
  points,
});
const tell = (tracks: Tracks, content: Record<string, unknown>, whole = false) => [
  ...tracks.take({ content: { type: 'tracks', ...content }, whole }),
];
const lons = (tracks: Tracks): number[] => tracks.of('1').map(({ lon_deg }) => lon_deg);

describe('tracks as the station tells them', () => {
  it('grow by what is new, and follow each other in time', () => {
    const tracks = new Tracks();
    expect(tell(tracks, { tracks: [leg('b', 0, [[3, 1, 0, 0]], '2026-11-22T11:00:00Z'), leg('a', 0, [[1, 1, 0, 0]])] }, true)).toEqual([
      '1',
    ]);
    tell(tracks, { tracks: [leg('a', 1, [[2, 1, 0, 1]])] });
    expect(lons(tracks)).toEqual([1, 2, 3]);
    tell(tracks, { removed: ['a', 'nobody'] });
    expect(lons(tracks)).toEqual([3]);
    expect(tell(tracks, { tracks: [] }, true)).toEqual(['1']);
    expect(lons(tracks)).toEqual([]);
  });
  it('lose what is no place and no track', () => {
    const tracks = new Tracks();
    tell(tracks, { tracks: [null, 3, { id: 'x' }, leg('a', 0, [[1], 'x', [1, 95], [1, 2]])] }, true);
    expect(lons(tracks)).toEqual([1]);
  });
});
