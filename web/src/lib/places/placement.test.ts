import { describe, expect, it } from 'vitest';
import { LEAST_POINTS, moved, place, type Affine, type ControlPoint, type Method, type Placement } from './placement';

/** Repeats exactly. */
function numbers(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48_271) % 2_147_483_647) / 2_147_483_647;
}

/** Turned, at a scale, somewhere; an affine one also stretched and sheared. */
function somewhere(random: () => number, method: Method): Affine {
  const [turn, scale] = [random() * 2 * Math.PI, 0.005 + random() * 0.2];
  const [cos, sin] = [scale * Math.cos(turn), scale * Math.sin(turn)];
  const [e, f] = [random() * 1000 - 500, random() * 1000 - 500];
  // Rows of a picture go down.
  const similar = { a: cos, b: sin, c: sin, d: -cos, e, f };
  if (method === 'similarity') return similar;
  const [stretch, shear] = [0.6 + random(), random() - 0.5];
  return { ...similar, a: cos * stretch, c: sin * stretch, b: sin + shear * cos, d: -cos + shear * sin };
}

function pointsOf(affine: Affine, count: number, random: () => number, noise = 0): ControlPoint[] {
  // Round a circle, so that they never lie in a line.
  return Array.from({ length: count }, (_, index) => {
    const angle = (2 * Math.PI * (index + 0.4 * random())) / Math.max(3, count);
    const [u, v] = [600 + 500 * Math.cos(angle), 400 + 350 * Math.sin(angle)];
    const { x, y } = moved(affine, u, v);
    return { u, v, x: x + noise * (random() - 0.5), y: y + noise * (random() - 0.5) };
  });
}

const done = (placed: Placement | string): Placement => {
  if (typeof placed === 'string') throw new Error(placed);
  return placed;
};

describe('placing a picture', () => {
  for (const method of ['similarity', 'affine'] as const) {
    it(`finds a ${method} again from as few points as it takes, and from more`, () => {
      const random = numbers(11);
      for (let i = 0; i < 300; i += 1) {
        const truth = somewhere(random, method);
        const count = LEAST_POINTS[method] + Math.floor(random() * 4);
        const { affine, residual_m } = done(place(pointsOf(truth, count, random), method));
        for (const key of ['a', 'b', 'c', 'd'] as const) expect(affine[key]).toBeCloseTo(truth[key], 9);
        expect(affine.e).toBeCloseTo(truth.e, 6);
        expect(affine.f).toBeCloseTo(truth.f, 6);
        expect(residual_m).toBeLessThan(1e-6);
      }
    });
  }

  it('keeps right angles and proportions as a similarity, whatever the points', () => {
    const random = numbers(5);
    for (let i = 0; i < 200; i += 1) {
      const { a, b, c, d } = done(place(pointsOf(somewhere(random, 'affine'), 4, random, 3), 'similarity')).affine;
      expect(a * b + c * d).toBeCloseTo(0, 9);
      expect(Math.hypot(a, c)).toBeCloseTo(Math.hypot(b, d), 9);
      expect(a * d - b * c).toBeLessThan(0); // never mirrored
    }
  });

  it('fits as well as can be: no other transform near it is nearer to the points', () => {
    const random = numbers(23);
    for (const method of ['similarity', 'affine'] as const) {
      for (let i = 0; i < 60; i += 1) {
        const points = pointsOf(somewhere(random, method), 5, random, 2);
        const { affine, residual_m } = done(place(points, method));
        const errorOf = (other: Affine): number =>
          Math.sqrt(
            points.reduce((sum, { u, v, x, y }) => sum + (moved(other, u, v).x - x) ** 2 + (moved(other, u, v).y - y) ** 2, 0) /
              points.length,
          );
        expect(errorOf(affine)).toBeCloseTo(residual_m, 9);
        const by = 1e-3 * (random() - 0.5);
        const others: Affine[] = [{ ...affine, e: affine.e + by }, { ...affine, f: affine.f + by }, { ...affine, a: affine.a + by / 500, d: affine.d - by / 500 }]; // prettier-ignore
        for (const other of others) expect(errorOf(other)).toBeGreaterThanOrEqual(residual_m - 1e-12);
      }
    }
  });

  it('tells how far it is off, in all and at each point', () => {
    const points = [{ u: 0, v: 0, x: 0, y: 0 }, { u: 100, v: 0, x: 10, y: 0 }, { u: 0, v: 100, x: 0, y: -11 }]; // prettier-ignore
    const { residual_m, residuals_m } = done(place(points, 'similarity'));
    expect(residual_m).toBeGreaterThan(0.1);
    expect(residual_m).toBeLessThan(1);
    expect(Math.sqrt(residuals_m.reduce((sum, one) => sum + one * one, 0) / 3)).toBeCloseTo(residual_m, 12);
    expect(done(place(points, 'affine')).residual_m).toBeLessThan(1e-9);
  });

  it('says what is wrong with points that say nothing', () => {
    const at = (u: number, v: number, x: number, y: number): ControlPoint => ({ u, v, x, y });
    expect(place([at(1, 1, 0, 0)], 'similarity')).toBe('1 more to choose');
    expect(place([at(1, 1, 0, 0)], 'affine')).toBe('2 more to choose');
    expect(place([at(1, 1, 0, 0), at(1.5, 1, 5, 5)], 'similarity')).toMatch(/too near/);
    expect(place([at(1, 1, 3, 3), at(90, 1, 3, 3)], 'similarity')).toMatch(/one place on the map/);
    expect(place([at(0, 0, 0, 0), at(50, 50, 5, 5), at(100, 100, 9, 1)], 'affine')).toMatch(/in a line in the picture/);
    expect(place([at(0, 0, 0, 0), at(90, 0, 5, 5), at(0, 90, 10, 10)], 'affine')).toMatch(/in a line on the map/);
    expect(place([at(0, 0, 0, 0), at(90, 0, 9, 0), at(0, 90, 0, 9)], 'affine')).toMatch(/mirror/);
  });
});
