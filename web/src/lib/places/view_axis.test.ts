import { describe, expect, it } from 'vitest';
import { axisText, viewAxis } from './view_axis';

const half = Math.SQRT1_2;

describe('where a camera looks', () => {
  it('is told by its view, and straight down by its upper edge', () => {
    // A camera upright and looking north: its x is east, its y down, its z north: a quarter turn about east.
    const north = viewAxis({ x: -half, y: 0, z: 0, w: half })!;
    expect(north.azimuth_deg).toBeCloseTo(0);
    expect(north.elevation_deg).toBeCloseTo(0);
    expect(axisText(north)).toBe('north (000°)');
    // Half a turn about east: it looks down, its upper edge north.
    const down = viewAxis({ x: 1, y: 0, z: 0, w: 0 })!;
    expect(down.isPlumb).toBe(true);
    expect(down.elevation_deg).toBeCloseTo(-90);
    expect(axisText(down)).toBe('straight down, its upper edge north (000°)');
    // The same turned by a quarter clockwise seen from above.
    const east = viewAxis({ x: half, y: -half, z: 0, w: 0 })!;
    expect(axisText(east)).toBe('straight down, its upper edge east (090°)');
    expect(axisText(viewAxis({ x: 0, y: 0, z: 0, w: 1 })!)).toMatch(/^straight up/);
  });

  it('is the third column of the turn, whatever the turn', () => {
    let seed = 7;
    const random = (): number => (seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647 - 0.5;
    for (let i = 0; i < 200; i += 1) {
      const raw = [random(), random(), random(), random()] as const;
      const length = Math.hypot(...raw);
      const [x, y, z, w] = raw.map((value) => value / length) as [number, number, number, number];
      // By two products of quaternions: q * (0, 0, 1) * conj(q).
      const [tx, ty] = [2 * y, -2 * x];
      const [east, north, up] = [w * tx - z * ty, w * ty + z * tx, 1 + x * ty - y * tx];
      const axis = viewAxis({ x, y, z, w })!;
      expect(Math.sin((axis.elevation_deg * Math.PI) / 180)).toBeCloseTo(up, 6);
      if (!axis.isPlumb) expect((axis.azimuth_deg + 360) % 360).toBeCloseTo(((Math.atan2(east, north) * 180) / Math.PI + 360) % 360, 6);
    }
  });

  it('is nothing for what is no turn', () => {
    expect(viewAxis({ x: 1, y: 1, z: 0, w: 0 })).toBeUndefined();
    expect(viewAxis({ x: NaN, y: 0, z: 0, w: 1 })).toBeUndefined();
  });
});
