import { FAMILY_WORDS } from '../map/shapes';
import type { Picture, VehicleFields, VehicleUpdate } from './protocol';
import { placedBySite, type AnchorOf } from './places/sites';

/** One vehicle as this browser knows it. `heardAt` is in ms of this browser's own clock, so ages need no common one. */
export interface Vehicle {
  id: string;
  fields: VehicleFields;
  heardAt: Record<string, number>;
  /** It has told no position: the one it has here is that of its pose in a site. */
  isPlacedBySite?: boolean;
}

export type Fleet = Map<string, Vehicle>;

/** Puts an update into the fleet, replacing the vehicle it changes; a full message also forgets vehicles it does not name. */
export function mergeUpdates(
  fleet: Fleet,
  updates: VehicleUpdate[],
  full: boolean,
  now: number,
  anchorOf: AnchorOf = () => undefined,
): Fleet {
  const merged = new Map<string, Vehicle>(full ? [] : fleet);
  for (const { id, age_s, ...fields } of updates) {
    const before = full ? undefined : fleet.get(id);
    const heardAt = { ...before?.heardAt };
    for (const [key, age] of Object.entries(age_s ?? {})) heardAt[key] = now - age * 1000;
    const known = { ...before?.fields, ...fields };
    const isPlacedBySite = known.site_pose !== undefined && !fields.position && (!known.position || before?.isPlacedBySite === true);
    merged.set(id, {
      id,
      fields: isPlacedBySite ? { ...known, ...placedBySite(known, anchorOf) } : known,
      heardAt,
      ...(isPlacedBySite && { isPlacedBySite }),
    });
  }
  // Once in order, a fleet to which nobody is added stays so.
  const isInOrder = !full && merged.size === fleet.size;
  return isInOrder ? merged : new Map([...merged].sort(([a], [b]) => compareIds(a, b)));
}

/** Numbers before and among each other as numbers, then text. */
export function compareIds(a: string, b: string): number {
  return a.length - b.length || (a < b ? -1 : a > b ? 1 : 0);
}

/** Seconds since anything was heard of it. */
export function linkAge(vehicle: Vehicle, now: number): number | undefined {
  return ageOf(vehicle, vehicle.fields.silent ? 'silent' : 'heartbeat', now);
}

/** Seconds since the key was heard; nothing when it never was. */
export function ageOf(vehicle: Vehicle, key: string, now: number): number | undefined {
  const heard = vehicle.heardAt[key];
  return heard === undefined ? undefined : Math.max(0, (now - heard) / 1000);
}

export function groundSpeed(vehicle: Vehicle): number | undefined {
  const velocity = vehicle.fields.velocity_m_s;
  return velocity && Math.hypot(velocity.north, velocity.east);
}

/** "3 copters, 1 rover". */
export function summaryOfKinds(vehicles: readonly Vehicle[]): string {
  const counts = new Map<string, number>();
  for (const { fields } of vehicles) {
    const kind = FAMILY_WORDS[fields.family ?? 'unknown'];
    counts.set(kind, (counts.get(kind) ?? 0) + 1);
  }
  return [...counts].map(([kind, count]) => `${count} ${kind}${count === 1 ? '' : 's'}`).join(', ');
}

export const PICTURE_LIMIT = 2000;

/** The pictures with those of a message behind them, the oldest going first; a full message forgets those before. */
export function addPictures(known: Map<string, Picture[]>, vehicle: string, fresh: Picture[], full: boolean): Map<string, Picture[]> {
  const before = full ? [] : (known.get(vehicle) ?? []);
  const newest = before.at(-1)?.number ?? 0;
  const all = [...before, ...fresh.filter(({ number }) => number > newest)];
  return new Map(known).set(vehicle, all.slice(-PICTURE_LIMIT));
}
