import type { Vehicle } from '../fleet';
import type { Position } from '../protocol';

/** A vehicle keeps so many points of where it has been, and now and then some more. */
export const TRAIL_LIMIT = 1500;
/** What is too old goes this many points at a time, not one by one. */
const TRIM = 100;
const STEP_M = 0.7;
const METRES_PER_DEGREE = 111_320;

/** Points are numbered from 0 as they come: who has drawn some of them knows which are new, and which are gone. */
export interface Trail {
  /** The number of the oldest point that is kept. */
  first: number;
  points: Position[];
}

/** Where the vehicles have been, growing in place. */
export class Trails {
  private readonly trails = new Map<string, Trail>();

  get(id: string): Trail | undefined {
    return this.trails.get(id);
  }

  entries(): IterableIterator<[string, Trail]> {
    return this.trails.entries();
  }

  /** All that is known of where a vehicle has been, instead of what was; its points are new ones for who has drawn others. */
  replace(id: string, points: readonly Position[]): void {
    const before = this.trails.get(id);
    const first = before ? before.first + before.points.length : 0;
    this.trails.set(id, { first, points: points.slice(-TRAIL_LIMIT) });
  }

  /** Adds where the vehicles are now, and forgets those that are gone; whether anything has changed by it. */
  grow(vehicles: Iterable<Vehicle>): boolean {
    let hasChanged = false;
    const present = new Set<string>();
    for (const { id, fields } of vehicles) {
      if (!fields.position) continue;
      present.add(id);
      hasChanged = this.extend(id, fields.position) || hasChanged;
    }
    for (const id of this.trails.keys()) if (!present.has(id)) hasChanged = this.trails.delete(id) || hasChanged;
    return hasChanged;
  }

  /** The position goes to the end when it is a step away from the last point. */
  private extend(id: string, position: Position): boolean {
    const trail = this.trails.get(id);
    if (!trail) {
      this.trails.set(id, { first: 0, points: [position] });
      return true;
    }
    const last = trail.points.at(-1);
    if (last && roughDistance(last, position) < STEP_M) return false;
    trail.points.push(position);
    if (trail.points.length >= TRAIL_LIMIT + TRIM) {
      trail.points.splice(0, TRIM);
      trail.first += TRIM;
    }
    return true;
  }
}

function roughDistance(a: Position, b: Position): number {
  const north = (b.lat_deg - a.lat_deg) * METRES_PER_DEGREE;
  const east = (b.lon_deg - a.lon_deg) * METRES_PER_DEGREE * Math.cos((a.lat_deg * Math.PI) / 180);
  return Math.hypot(north, east);
}
