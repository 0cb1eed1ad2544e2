import type { LonLat } from '../../map/geometry';
import type { Position } from '../protocol';

const METRES_PER_DEGREE = 111_319.49;
/** Two standard deviations: 19 of 20 times it is within, along each axis. */
const DEVIATIONS = 2;
const CORNERS = 32;
/** More than any robot tells: what there is beyond is not drawn. */
const MOST_POINTS = 1000;

export interface PoseSpread {
  major_m: number;
  minor_m: number;
  /** Counterclockwise from east. */
  axis_rad: number;
}

/** What a robot intends and knows of its floor. */
export interface RobotSketch {
  id: string;
  way: LonLat[];
  frontiers: LonLat[];
  spread: PoseSpread | undefined;
}

/** Of a message of the feed `robots`; what cannot be read is left out. */
export function sketchesOf(content: unknown): RobotSketch[] {
  const { robots } = (content ?? {}) as { robots?: unknown };
  if (!Array.isArray(robots)) return [];
  return robots.flatMap((one: { id?: unknown; way?: unknown; frontiers?: unknown; spread?: unknown }) =>
    typeof one?.id === 'string'
      ? [{ id: one.id, way: placesOf(one.way), frontiers: placesOf(one.frontiers), spread: spreadOf(one.spread) }]
      : [],
  );
}

/** Where it may be, as a ring around where it is. */
export function ellipseOf(spread: PoseSpread, { lat_deg, lon_deg }: Position): LonLat[] {
  const east = METRES_PER_DEGREE * Math.max(0.01, Math.cos((lat_deg * Math.PI) / 180));
  const [cosine, sine] = [Math.cos(spread.axis_rad), Math.sin(spread.axis_rad)];
  const ring: LonLat[] = [];
  for (let i = 0; i <= CORNERS; ++i) {
    const angle = (2 * Math.PI * i) / CORNERS;
    const along = DEVIATIONS * spread.major_m * Math.cos(angle);
    const across = DEVIATIONS * spread.minor_m * Math.sin(angle);
    ring.push([lon_deg + (along * cosine - across * sine) / east, lat_deg + (along * sine + across * cosine) / METRES_PER_DEGREE]);
  }
  return ring;
}

function placesOf(given: unknown): LonLat[] {
  if (!Array.isArray(given)) return [];
  const places = given as unknown[];
  return places.slice(0, MOST_POINTS).flatMap((place) => (isPlace(place) ? [place] : []));
}

function isPlace(place: unknown): place is LonLat {
  return Array.isArray(place) && place.length === 2 && within(place[0], 180) && within(place[1], 90);
}

function spreadOf(given: unknown): PoseSpread | undefined {
  const { major_m, minor_m, axis_rad } = (given ?? {}) as Record<string, unknown>;
  const farthest_m = 1e4;
  return within(major_m, farthest_m) && within(minor_m, farthest_m) && within(axis_rad, 7) ? { major_m, minor_m, axis_rad } : undefined;
}

function within(value: unknown, most: number): value is number {
  return typeof value === 'number' && Math.abs(value) <= most;
}
