/** A place in a picture, in px from its upper left corner, and the same place in metres east and north of some origin. */
export interface ControlPoint {
  u: number;
  v: number;
  x: number;
  y: number;
}

/** x = a u + b v + e, y = c u + d v + f: from a picture's px to metres. */
export interface Affine {
  a: number;
  b: number;
  c: number;
  d: number;
  e: number;
  f: number;
}

/** Keeps right angles and proportions, or stretches either way. */
export type Method = 'similarity' | 'affine';

export interface Placement {
  affine: Affine;
  /** Root of the mean square distance from each point to where the transform has it, in metres. */
  residual_m: number;
  /** Of each point, in metres. */
  residuals_m: readonly number[];
}

/** How many points each takes at least. */
export const LEAST_POINTS: Readonly<Record<Method, number>> = { similarity: 2, affine: 3 };

/** So little of a spread, of that of the other axis, is a line and no plane; points this near to each other, in px, are one. */
const LEAST_SHARE = 1e-4;
const LEAST_PX = 2;

interface Centred {
  u: number;
  v: number;
  x: number;
  y: number;
}

/** By least squares; or in words for people why it cannot be. */
export function place(points: readonly ControlPoint[], method: Method): Placement | string {
  if (points.length < LEAST_POINTS[method]) return `${LEAST_POINTS[method] - points.length} more to choose`;
  const middle = meanOf(points);
  const centred = points.map(({ u, v, x, y }) => ({ u: u - middle.u, v: v - middle.v, x: x - middle.x, y: y - middle.y }));
  const linear = method === 'similarity' ? similar(centred) : stretched(centred);
  if (typeof linear === 'string') return linear;
  const { a, b, c, d } = linear;
  const affine = { a, b, c, d, e: middle.x - a * middle.u - b * middle.v, f: middle.y - c * middle.u - d * middle.v };
  const residuals_m = points.map(({ u, v, x, y }) => {
    const at = moved(affine, u, v);
    return Math.hypot(at.x - x, at.y - y);
  });
  return { affine, residuals_m, residual_m: Math.sqrt(residuals_m.reduce((sum, one) => sum + one * one, 0) / points.length) };
}

export function moved({ a, b, c, d, e, f }: Affine, u: number, v: number): { x: number; y: number } {
  return { x: a * u + b * v + e, y: c * u + d * v + f };
}

function meanOf(points: readonly Centred[]): Centred {
  const sum = points.reduce((all, { u, v, x, y }) => ({ u: all.u + u, v: all.v + v, x: all.x + x, y: all.y + y }), {
    u: 0,
    v: 0,
    x: 0,
    y: 0,
  });
  const count = points.length;
  return { u: sum.u / count, v: sum.v / count, x: sum.x / count, y: sum.y / count };
}

type Linear = Pick<Affine, 'a' | 'b' | 'c' | 'd'>;
const sumOf = (points: readonly Centred[], term: (point: Centred) => number): number => points.reduce((sum, point) => sum + term(point), 0);

/** As complex numbers z = k w, where w = u - i v: a picture's rows go down. */
function similar(points: readonly Centred[]): Linear | string {
  const spread = sumOf(points, ({ u, v }) => u * u + v * v);
  if (Math.sqrt(spread / points.length) < LEAST_PX) return 'the points lie too near to each other in the picture';
  const real = sumOf(points, ({ u, v, x, y }) => x * u - y * v) / spread;
  const imaginary = sumOf(points, ({ u, v, x, y }) => y * u + x * v) / spread;
  if (Math.hypot(real, imaginary) === 0 || !Number.isFinite(real + imaginary)) return 'the points lie in one place on the map';
  return { a: real, b: imaginary, c: imaginary, d: -real };
}

function stretched(points: readonly Centred[]): Linear | string {
  const [uu, uv, vv] = [sumOf(points, (p) => p.u * p.u), sumOf(points, (p) => p.u * p.v), sumOf(points, (p) => p.v * p.v)];
  const determinant = uu * vv - uv * uv;
  if (!(determinant > LEAST_SHARE * (uu + vv) ** 2) || uu + vv < LEAST_PX ** 2 * points.length)
    return 'the points lie in a line in the picture: choose one beside it';
  const [xu, xv, yu, yv] = [sumOf(points, (p) => p.x * p.u), sumOf(points, (p) => p.x * p.v), sumOf(points, (p) => p.y * p.u), sumOf(points, (p) => p.y * p.v)]; // prettier-ignore
  const solved = {
    a: (xu * vv - xv * uv) / determinant,
    b: (xv * uu - xu * uv) / determinant,
    c: (yu * vv - yv * uv) / determinant,
    d: (yv * uu - yu * uv) / determinant,
  };
  const area = solved.a * solved.d - solved.b * solved.c;
  const size = solved.a ** 2 + solved.b ** 2 + solved.c ** 2 + solved.d ** 2;
  if (!(Math.abs(area) > LEAST_SHARE * size)) return 'the points lie in a line on the map: choose one beside it';
  // Rows go down and north goes up, so what is not mirrored has a negative area.
  return area < 0 ? solved : 'the points mirror the picture: is one of them at the wrong place?';
}
