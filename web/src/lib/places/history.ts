import { groundSpeed, type Vehicle } from '../fleet';

/** What charts show of a vehicle, each as it was in one second; `undefined` while nobody knew. */
export interface Sample {
  /** By this browser's clock in ms. */
  at: number;
  height_m: number | undefined;
  speed_m_s: number | undefined;
  /** Of the first battery, 0 to 1. */
  battery: number | undefined;
  /** Share of messages that come through, 0 to 1. */
  link: number | undefined;
}

/** A few minutes: what is older is the station's to tell. */
export const HISTORY_S = 300;
/** A chart is so long at least: what has just begun is not to fill it. */
export const CHART_LEAST_S = 60;
const STEP_MS = 1000;

export class History {
  private readonly samples = new Map<string, Sample[]>();
  private last = -Infinity;

  of(id: string): readonly Sample[] {
    return this.samples.get(id) ?? [];
  }

  /** Notes how the vehicles are now, if a second has gone by; whether it has. */
  note(vehicles: Iterable<Vehicle>, now: number): boolean {
    if (now - this.last < STEP_MS) return false;
    this.last = now;
    const present = new Set<string>();
    for (const vehicle of vehicles) {
      present.add(vehicle.id);
      const known = this.samples.get(vehicle.id) ?? [];
      this.samples.set(vehicle.id, known);
      known.push(sampleOf(vehicle, now));
      const old = known.findIndex(({ at }) => at > now - HISTORY_S * 1000);
      if (old > 0) known.splice(0, old);
    }
    for (const id of this.samples.keys()) if (!present.has(id)) this.samples.delete(id);
    return true;
  }
}

function sampleOf(vehicle: Vehicle, at: number): Sample {
  const { relative_alt_m, battery } = vehicle.fields;
  return { at, height_m: relative_alt_m, speed_m_s: groundSpeed(vehicle), battery: battery?.remaining, link: linkShare(vehicle) };
}

/** What comes through on the link in use; nothing comes from who is silent. */
export function linkShare({ fields: { silent, connection, links } }: Vehicle): number | undefined {
  if (silent || connection === 'lost') return 0;
  const loss = links?.find(({ used }) => used)?.loss;
  return loss === undefined ? undefined : 1 - loss;
}

/**
 * The path of an SVG's line through the values over `width` x `height`, the newest at the right end; where a value is not known the line
 * has a gap. `range` is what lies at the bottom and at the top.
 */
export function linePath(
  values: readonly (number | undefined)[],
  most: number,
  [low, high]: [number, number],
  width: number,
  height: number,
): string {
  const step = width / Math.max(1, most - 1);
  const start = width - (values.length - 1) * step;
  let path = '';
  let isDown = false;
  values.forEach((value, index) => {
    if (value === undefined) return (isDown = false);
    const y = height - ((Math.min(high, Math.max(low, value)) - low) / (high - low || 1)) * height;
    path += `${isDown ? 'L' : 'M'}${(start + index * step).toFixed(1)} ${y.toFixed(1)}`;
    return (isDown = true);
  });
  return path;
}

/** Of what has no natural one: from a round number below the least to one above the most, not less than `least` apart. */
export function rangeOf(values: readonly (number | undefined)[], least: number): [number, number] {
  const known = values.filter((value) => value !== undefined);
  if (known.length === 0) return [0, least];
  const [low, high] = [Math.min(...known), Math.max(...known)];
  const missing = Math.max(0, least - (high - low)) / 2;
  return [Math.floor(low - missing), Math.ceil(high + missing)];
}
