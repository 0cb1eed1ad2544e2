import { heading, latitude, longitude, metres } from '../lib/format';
import type { Position } from '../lib/protocol';

export type LonLat = [number, number];
/** Wherever how high it is does not matter. */
export interface Place {
  lat_deg: number;
  lon_deg: number;
}
export interface Bounds {
  west: number;
  south: number;
  east: number;
  north: number;
}

const METRES_PER_DEGREE = 111_319.49;
/** Beyond it a map of this projection has no place. */
export const MAP_END_DEG = 85;

/** The smallest bounds round the positions, at least `leastSpan` metres wide and high; nothing for none. */
export function boundsOf(positions: readonly Place[], leastSpan: number): Bounds | undefined {
  if (positions.length === 0) return undefined;
  const lats = positions.map((p) => p.lat_deg);
  const lons = positions.map((p) => p.lon_deg);
  const middleLat = (Math.min(...lats) + Math.max(...lats)) / 2;
  const [south, north] = widened(Math.min(...lats), Math.max(...lats), leastSpan / METRES_PER_DEGREE);
  const [west, east] = widened(Math.min(...lons), Math.max(...lons), leastSpan / metresPerDegreeEast(middleLat));
  const onMap = (lat: number): number => Math.max(-MAP_END_DEG, Math.min(MAP_END_DEG, lat));
  return { west, south: onMap(south), east, north: onMap(north) };
}

/** The smallest bounds round both. */
export function cover(a: Bounds, b: Bounds): Bounds {
  return {
    west: Math.min(a.west, b.west),
    south: Math.min(a.south, b.south),
    east: Math.max(a.east, b.east),
    north: Math.max(a.north, b.north),
  };
}

/** Wider and higher by that share on each side. */
export function widenedBy({ west, south, east, north }: Bounds, share: number): Bounds {
  const [across, up] = [(east - west) * share, (north - south) * share];
  return { west: west - across, south: Math.max(-MAP_END_DEG, south - up), east: east + across, north: Math.min(MAP_END_DEG, north + up) };
}

export function contains(outer: Bounds, inner: Bounds): boolean {
  return outer.west <= inner.west && outer.south <= inner.south && outer.east >= inner.east && outer.north >= inner.north;
}

/** Whether the point lies within the polygon, which may cross itself: then by the rule of even and odd. */
export function isInside([x, y]: LonLat, polygon: readonly LonLat[]): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [ax, ay] = polygon[i]!;
    const [bx, by] = polygon[j]!;
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

function widened(low: number, high: number, least: number): [number, number] {
  const missing = Math.max(0, least - (high - low)) / 2;
  return [low - missing, high + missing];
}

/** 1, 2 or 5 times a power of ten, the smallest that is not below `value`. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return power * (lead <= 1 + 1e-9 ? 1 : lead <= 2 + 1e-9 ? 2 : lead <= 5 + 1e-9 ? 5 : 10);
}

export interface GridLine {
  points: LonLat[];
  label: string;
  major: boolean;
}

/**
 * A grid over the view with about `lines` lines a side. Near `origin` it counts metres north and east of it, as operators of a
 * field do; in wide views, or without an origin, it is the graticule in degrees.
 */
export function gridLines(view: Bounds, origin: Position | undefined, lines: number): GridLine[] {
  const heightM = (view.north - view.south) * METRES_PER_DEGREE;
  const isLocal = origin && heightM < 40_000 && Math.abs((view.north + view.south) / 2 - origin.lat_deg) < 1;
  return isLocal ? metricGrid(view, origin, niceStep(heightM / lines)) : graticule(view, lines);
}

function metricGrid(view: Bounds, origin: Position, step: number): GridLine[] {
  const east = metresPerDegreeEast(origin.lat_deg);
  const grid: GridLine[] = [];
  for (const metres of multiples((view.west - origin.lon_deg) * east, (view.east - origin.lon_deg) * east, step)) {
    const lon = origin.lon_deg + metres / east;
    grid.push(line([lon, view.south], [lon, view.north], offset(metres, 'E', 'W'), metres, step));
  }
  const south = (view.south - origin.lat_deg) * METRES_PER_DEGREE;
  const north = (view.north - origin.lat_deg) * METRES_PER_DEGREE;
  for (const metres of multiples(south, north, step)) {
    const lat = origin.lat_deg + metres / METRES_PER_DEGREE;
    grid.push(line([view.west, lat], [view.east, lat], offset(metres, 'N', 'S'), metres, step));
  }
  return grid;
}

function graticule(view: Bounds, lines: number): GridLine[] {
  const step = Math.min(30, niceStep((view.north - view.south) / lines));
  const grid: GridLine[] = [];
  for (const lon of multiples(view.west, view.east, step)) {
    const wrapped = ((((lon + 180) % 360) + 360) % 360) - 180;
    grid.push(line([lon, view.south], [lon, view.north], degrees(wrapped, step, 'E', 'W'), lon, step));
  }
  for (const lat of multiples(Math.max(-MAP_END_DEG, view.south), Math.min(MAP_END_DEG, view.north), step)) {
    grid.push(line([view.west, lat], [view.east, lat], degrees(lat, step, 'N', 'S'), lat, step));
  }
  return grid;
}

function line(from: LonLat, to: LonLat, label: string, value: number, step: number): GridLine {
  return { points: [from, to], label, major: Math.round(value / step) % 5 === 0 };
}

function* multiples(low: number, high: number, step: number): Generator<number> {
  for (let i = Math.ceil(low / step); i <= Math.floor(high / step); ++i) yield i * step;
}

function offset(metres: number, positive: string, negative: string): string {
  const size = Math.abs(metres);
  if (size < 1e-6) return '0';
  const text = size >= 1000 ? `${Number((size / 1000).toFixed(3))} km` : `${Number(size.toFixed(2))} m`;
  return `${text} ${metres < 0 ? negative : positive}`;
}

function degrees(value: number, step: number, positive: string, negative: string): string {
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (Math.abs(value) < step / 2) return '0°';
  return `${Math.abs(value).toFixed(decimals)}° ${value < 0 ? negative : positive}`;
}

/** Where a place is, seen from a vehicle near it: "120 m at 045° from copter 1"; in degrees without one. */
export function placeText(place: Place, from?: Place & { name: string }): string {
  if (!from) return `${latitude(place.lat_deg)}, ${longitude(place.lon_deg)}`;
  const north = (place.lat_deg - from.lat_deg) * METRES_PER_DEGREE;
  const east = (place.lon_deg - from.lon_deg) * metresPerDegreeEast(from.lat_deg);
  const distance = Math.hypot(north, east);
  return distance < 0.5 ? `at ${from.name}` : `${metres(distance)} at ${heading(Math.atan2(east, north))} from ${from.name}`;
}

function metresPerDegreeEast(latDeg: number): number {
  return METRES_PER_DEGREE * Math.max(0.01, Math.cos((latDeg * Math.PI) / 180));
}
