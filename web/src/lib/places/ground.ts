import type { Position } from '../protocol';
import { moved, type Affine, type ControlPoint } from './placement';

type LonLat = [number, number];
interface Place {
  lat_deg: number;
  lon_deg: number;
}

const METRES_PER_DEGREE = 111_319.49;

/** Metres east and north of a place, and back: for what is no larger than a building or its grounds. */
export class Ground {
  private readonly east: number;

  constructor(private readonly origin: Place) {
    this.east = METRES_PER_DEGREE * Math.max(0.01, Math.cos((origin.lat_deg * Math.PI) / 180));
  }

  metres({ lat_deg, lon_deg }: Place): { x: number; y: number } {
    return { x: (lon_deg - this.origin.lon_deg) * this.east, y: (lat_deg - this.origin.lat_deg) * METRES_PER_DEGREE };
  }

  place({ x, y }: { x: number; y: number }): Position {
    return { lon_deg: this.origin.lon_deg + x / this.east, lat_deg: this.origin.lat_deg + y / METRES_PER_DEGREE, alt_m: 0 };
  }

  /** Where the corners of a picture lie, from its upper left one clockwise. */
  corners(affine: Affine, width: number, height: number): LonLat[] {
    const at = ([u, v]: readonly [number, number]): LonLat => {
      const { lon_deg, lat_deg } = this.place(moved(affine, u, v));
      return [lon_deg, lat_deg];
    };
    return ([[0, 0], [width, 0], [width, height], [0, height]] as const).map(at); // prettier-ignore
  }
}

/**
 * The corners of a picture's footprint from its upper left one clockwise, as the picture has them: GeoJSON's outer rings go
 * counterclockwise (RFC 7946, 3.1.6), from the same first corner. None for what has not four corners.
 */
export function pictureCorners(ring: readonly (readonly number[])[]): [LonLat, LonLat, LonLat, LonLat] | undefined {
  if (ring.length !== 5) return undefined;
  const [a, b, c, d] = ring.map(([lon, lat]): LonLat => [lon!, lat!]) as [LonLat, LonLat, LonLat, LonLat];
  const twiceArea = (c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]);
  return twiceArea > 0 ? [a, d, c, b] : [a, b, c, d];
}

/** A place in a picture, and where it is on the globe. */
export interface Pair {
  u: number;
  v: number;
  at: Place;
}

export function controlPoints(ground: Ground, pairs: readonly Pair[]): ControlPoint[] {
  return pairs.map(({ u, v, at }) => ({ u, v, ...ground.metres(at) }));
}
