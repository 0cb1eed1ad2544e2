import { describe, expect, it } from 'vitest';
import { coordinatesText } from './coordinates';

describe('a place in words', () => {
  // The Eiffel tower, and a place south of the equator, as PROJ has them.
  const tower = { lat_deg: 48.858222, lon_deg: 2.2945 };
  const canberra = { lat_deg: -35.363262, lon_deg: 149.165237 };

  it('is told in degrees', () => expect(coordinatesText(tower, 'WGS84')).toBe('48.85822° N, 2.29450° E'));
  it('is told in UTM', () => {
    expect(coordinatesText(tower, 'UTM')).toBe('31U 448251 E 5411935 N');
    expect(coordinatesText(canberra, 'UTM')).toBe('55H 696719 E 6084519 N');
  });
  it('is told in MGRS', () => expect(coordinatesText(tower, 'MGRS')).toBe('31U DQ 48251 11935'));
  it('is told in degrees near the poles, where the others end', () => {
    for (const form of ['UTM', 'MGRS'] as const)
      expect(coordinatesText({ lat_deg: 84.5, lon_deg: 190 }, form)).toBe('84.50000° N, 170.00000° W');
  });
});
