import { describe, expect, it } from 'vitest';
import { boundsOf, contains, cover, gridLines, isInside, niceStep, placeText, widenedBy } from './geometry';

const origin = { lat_deg: -35.363262, lon_deg: 149.165237, alt_m: 584 };

describe('boundsOf', () => {
  it('is nothing for no place', () => expect(boundsOf([], 100)).toBeUndefined());
  it('holds all places', () => {
    const bounds = boundsOf([origin, { lat_deg: -35.3, lon_deg: 149.2, alt_m: 0 }], 10);
    expect(bounds).toEqual({ south: -35.363262, north: -35.3, west: 149.165237, east: 149.2 });
  });
  it('has a least span in metres, both ways', () => {
    const bounds = boundsOf([origin], 100)!;
    expect((bounds.north - bounds.south) * 111_319.49).toBeCloseTo(100, 3);
    expect((bounds.east - bounds.west) * 111_319.49 * Math.cos((35.363262 * Math.PI) / 180)).toBeCloseTo(100, 3);
  });
});

describe('niceStep', () => {
  it.each([
    [0.9, 1],
    [1, 1],
    [1.1, 2],
    [3, 5],
    [5.1, 10],
    [0.03, 0.05],
    [700, 1000],
  ])('%d -> %d', (value, step) => {
    expect(niceStep(value)).toBeCloseTo(step, 10);
  });
});

describe('gridLines', () => {
  const near = { south: origin.lat_deg - 0.001, north: origin.lat_deg + 0.001, west: origin.lon_deg - 0.001, east: origin.lon_deg + 0.001 };

  it('counts metres from the origin when it is near', () => {
    const labels = gridLines(near, origin, 12).map((line) => line.label);
    expect(labels).toContain('0');
    expect(labels).toContain('100 m N');
    expect(labels).toContain('60 m W');
  });
  it('runs through the origin', () => {
    const zero = gridLines(near, origin, 12).find((line) => line.label === '0');
    expect(zero?.points[0]?.[0]).toBeCloseTo(origin.lon_deg, 9);
    expect(zero?.major).toBe(true);
  });
  it('counts degrees without an origin, or far from it', () => {
    expect(gridLines(near, undefined, 12).every((line) => line.label.includes('°'))).toBe(true);
    const world = { south: -85, north: 85, west: -180, east: 180 };
    const labels = gridLines(world, origin, 12).map((line) => line.label);
    expect(labels).toContain('60° N');
    expect(labels).toContain('0°');
    expect(labels.length).toBeLessThan(60);
  });
  it('wraps longitudes beyond the date line', () => {
    const labels = gridLines({ south: -10, north: 10, west: 175, east: 190 }, undefined, 5).map((line) => line.label);
    expect(labels).toContain('175° W');
  });
});

describe('cover and contains', () => {
  const inner = { west: 1, south: 1, east: 2, north: 2 };
  const other = { west: 0, south: 1.5, east: 1.5, north: 3 };
  it('hold both', () => {
    expect(cover(inner, other)).toEqual({ west: 0, south: 1, east: 2, north: 3 });
    expect(contains(cover(inner, other), inner)).toBe(true);
    expect(contains(inner, other)).toBe(false);
    expect(contains(inner, inner)).toBe(true);
  });
});

it('widens to each side, not beyond the map', () => {
  expect(widenedBy({ west: 0, south: 0, east: 10, north: 20 }, 0.1)).toEqual({ west: -1, south: -2, east: 11, north: 22 });
  expect(widenedBy({ west: 0, south: 0, east: 10, north: 84 }, 0.5).north).toBe(85);
});

describe('isInside', () => {
  const hook: [number, number][] = [[0, 0], [10, 0], [10, 10], [6, 10], [6, 4], [0, 4]]; // prettier-ignore
  it('follows the outline', () => {
    expect(isInside([2, 2], hook)).toBe(true);
    expect(isInside([8, 8], hook)).toBe(true);
    expect(isInside([2, 8], hook)).toBe(false);
    expect(isInside([12, 2], hook)).toBe(false);
  });
  it('is nowhere in nothing', () => expect(isInside([0, 0], [])).toBe(false));
});

describe('placeText', () => {
  const copter = { ...origin, name: 'copter 1' };
  it('tells distance and bearing from a vehicle', () => {
    expect(placeText({ lat_deg: origin.lat_deg + 0.001, lon_deg: origin.lon_deg }, copter)).toBe('111 m at 000° from copter 1');
    expect(placeText({ lat_deg: origin.lat_deg, lon_deg: origin.lon_deg - 0.001 }, copter)).toBe('91 m at 270° from copter 1');
  });
  it("says when it is the vehicle's own", () => expect(placeText(origin, copter)).toBe('at copter 1'));
  it('tells degrees without a vehicle', () => expect(placeText(origin)).toBe('35.36326° S, 149.16524° E'));
});

it('keeps bounds on the map, however near to a pole', () => {
  const bounds = boundsOf([{ lat_deg: 90, lon_deg: 0 }], 60);
  expect(bounds?.north).toBeLessThanOrEqual(85);
  expect(bounds?.south).toBeLessThanOrEqual(bounds!.north);
});
