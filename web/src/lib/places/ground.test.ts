import { describe, expect, it } from 'vitest';
import { pictureCorners } from './ground';

const [A, B, C, D] = [[8, 47.1], [8.1, 47.1], [8.1, 47], [8, 47]] as const; // prettier-ignore

describe('corners of a footprint', () => {
  it('go clockwise from the upper left one, whichever way the ring goes', () => {
    expect(pictureCorners([A, B, C, D, A])).toEqual([A, B, C, D]);
    expect(pictureCorners([A, D, C, B, A])).toEqual([A, B, C, D]);
  });

  it('are those of the picture, however it is turned', () => {
    expect(pictureCorners([C, B, A, D, C])).toEqual([C, D, A, B]);
  });

  it('are none where there are not four', () => {
    expect(pictureCorners([A, B, C, A])).toBeUndefined();
  });
});
