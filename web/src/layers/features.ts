import type { Feature, FeatureCollection } from 'geojson';
import { MAP_END_DEG, type LonLat } from '../map/geometry';
import type { Position } from '../lib/protocol';

/** On the map, which ends before the poles. */
export function lonLat({ lat_deg, lon_deg }: Position): LonLat {
  return [lon_deg, Math.max(-MAP_END_DEG, Math.min(MAP_END_DEG, lat_deg))];
}

/** A line, or a point, with what its look depends on. */
export interface Mark {
  id?: number;
  properties: Record<string, unknown>;
  line?: LonLat[];
  point?: LonLat;
}

/** A line of less than two points is none. */
export function featureOf({ id, properties, line, point }: Mark): Feature | undefined {
  const head = { type: 'Feature', ...(id !== undefined && { id }), properties } as const;
  if (line && line.length > 1) return { ...head, geometry: { type: 'LineString', coordinates: line } };
  if (point) return { ...head, geometry: { type: 'Point', coordinates: point } };
  return undefined;
}

export function featuresOf(marks: Iterable<Mark>): FeatureCollection {
  return { type: 'FeatureCollection', features: [...marks].flatMap((mark) => featureOf(mark) ?? []) };
}

/** One line a vehicle, coloured as it is. */
export function pathFeatures(paths: Iterable<[string, Position[]]>, colourOf: (id: string) => string): FeatureCollection {
  return featuresOf([...paths].map(([id, path]) => ({ properties: { id, colour: colourOf(id) }, line: path.map(lonLat) })));
}

/** Vehicles that stand side by side share a mark. */
export function placeKey({ lat_deg, lon_deg }: { lat_deg: number; lon_deg: number }): string {
  return `${lat_deg.toFixed(5)} ${lon_deg.toFixed(5)}`;
}

/** Takes away the marks of what is not there any more. */
export function removeMissing(shown: Map<string, { remove(): void }>, isPresent: (key: string) => boolean): void {
  for (const [key, mark] of shown) {
    if (isPresent(key)) continue;
    mark.remove();
    shown.delete(key);
  }
}
