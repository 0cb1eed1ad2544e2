import type { Frame } from '../../connection/frame';
import type { Position } from '../protocol';

interface Leg {
  vehicle: string;
  began_at: string;
  points: Position[];
}

/** Where vehicles have been, in legs, as the station tells it: a leg that has grown is told by its new points alone. */
export class Tracks {
  private readonly legs = new Map<string, Leg>();

  /** Whose tracks are other ones now. */
  take({ content, whole }: Pick<Frame, 'content' | 'whole'>): Set<string> {
    const changed = new Set<string>();
    if (content instanceof Uint8Array || content.type !== 'tracks') return changed;
    if (whole) this.forgetAll(changed);
    for (const id of listOf(content.removed)) this.forget(id, changed);
    for (const told of listOf(content.tracks)) this.add(told, changed);
    return changed;
  }

  of(vehicle: string): Position[] {
    const legs = [...this.legs.values()].filter((leg) => leg.vehicle === vehicle);
    legs.sort((a, b) => (a.began_at < b.began_at ? -1 : 1));
    return legs.flatMap(({ points }) => points);
  }

  private forgetAll(changed: Set<string>): void {
    for (const { vehicle } of this.legs.values()) changed.add(vehicle);
    this.legs.clear();
  }

  private forget(id: unknown, changed: Set<string>): void {
    const leg = typeof id === 'string' && this.legs.get(id);
    if (!leg) return;
    changed.add(leg.vehicle);
    this.legs.delete(id);
  }

  private add(told: unknown, changed: Set<string>): void {
    const { id, vehicle, began_at, from, points } = (told ?? {}) as Record<string, unknown>;
    if (typeof id !== 'string' || typeof vehicle !== 'string' || typeof began_at !== 'string' || typeof from !== 'number') return;
    const known = this.legs.get(id)?.points ?? [];
    this.legs.set(id, { vehicle, began_at, points: [...known.slice(0, from), ...listOf(points).flatMap((point) => placeOf(point) ?? [])] });
    changed.add(vehicle);
  }
}

function listOf(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

/** Of longitude, latitude, height and time; heights count from the site's anchor, and are not shown. */
function placeOf(point: unknown): Position | undefined {
  const [lon_deg, lat_deg] = listOf(point);
  const isPlace = typeof lon_deg === 'number' && typeof lat_deg === 'number' && Math.abs(lat_deg) <= 90;
  return isPlace ? { lat_deg, lon_deg, alt_m: 0 } : undefined;
}
