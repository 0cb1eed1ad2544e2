import type { Geometry } from 'geojson';
import type { MapFeature } from '../layers/found/map_features';
import type { LonLatBox } from '../layers/found/tile_span';

export const KINDS = ['added', 'changed', 'removed'] as const;
export type Kind = (typeof KINDS)[number];

/** Something on the map that was added, says something else, or is there no more. */
export interface FeatureChange {
  kind: Kind;
  layer: string;
  id: string;
  /** As it is now; of what is gone as it was. */
  feature: MapFeature;
  /** What it said and says, of what has changed. */
  values: { property: string; before: string; after: string }[];
}

/** An occupancy grid of which cells have changed. */
export interface GridChange {
  key: string;
  name: string;
  site: string;
  floor: string;
  bounds: LonLatBox;
  pictures: string;
  taken: number;
  freed: number;
  other: number;
}

export interface Changes {
  features: FeatureChange[];
  grids: GridChange[];
  /** There are more than the station tells. */
  left_out: number;
}

export function changesOf(answer: Record<string, unknown>): Changes {
  return {
    features: listOf(answer.layers).flatMap(layerChanges),
    grids: listOf(answer.grids).flatMap((one) => gridChange(one) ?? []),
    left_out: typeof answer.left_out === 'number' ? answer.left_out : 0,
  };
}

function layerChanges(value: unknown): FeatureChange[] {
  const { layer, added, changed, removed } = objectOf(value);
  if (typeof layer !== 'string') return [];
  const plain = (kind: Kind, list: unknown): FeatureChange[] =>
    listOf(list).flatMap((feature) => (isFeature(feature) ? [{ kind, layer, id: feature.id, feature, values: [] }] : []));
  const others = listOf(changed).flatMap((one): FeatureChange[] => {
    const { before, after, properties } = objectOf(one);
    if (!isFeature(before) || !isFeature(after)) return [];
    const values = listOf(properties).map((name) => valuesOf(String(name), before, after));
    return [{ kind: 'changed', layer, id: after.id, feature: after, values }];
  });
  return [...plain('added', added), ...others, ...plain('removed', removed)];
}

function valuesOf(property: string, before: MapFeature, after: MapFeature): FeatureChange['values'][number] {
  if (property === 'geometry') return { property: 'place', before: 'there', after: 'here' };
  return {
    property: property.replaceAll('_', ' '),
    before: textOf(before.properties[property]),
    after: textOf(after.properties[property]),
  };
}

function textOf(value: unknown): string {
  if (value === undefined || value === null) return 'nothing';
  return typeof value === 'string' ? value : JSON.stringify(value);
}

function gridChange(value: unknown): GridChange | undefined {
  const { site, floor, name, bounds, pictures, taken, freed, other } = objectOf(value);
  const isBox = Array.isArray(bounds) && bounds.length === 4 && bounds.every((number) => typeof number === 'number');
  if (typeof site !== 'string' || typeof floor !== 'string' || typeof name !== 'string' || typeof pictures !== 'string' || !isBox)
    return undefined;
  const count = (number: unknown): number => (typeof number === 'number' ? number : 0);
  const key = `changes ${site} ${floor} ${name}`;
  const counts = { taken: count(taken), freed: count(freed), other: count(other) };
  return { key, name, site, floor, bounds: bounds as LonLatBox, pictures, ...counts };
}

function objectOf(value: unknown): Record<string, unknown> {
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>) : {};
}

function listOf(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

function isFeature(value: unknown): value is MapFeature {
  const { id, geometry, properties } = objectOf(value);
  return typeof id === 'string' && Array.isArray(objectOf(geometry).coordinates) && typeof properties === 'object' && properties !== null;
}

/** The rectangle round it. */
export function boundsOf(geometry: Geometry): LonLatBox {
  const box: LonLatBox = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (places: unknown): void => {
    if (!Array.isArray(places)) return;
    const [lon, lat] = places as unknown[];
    if (typeof lon !== 'number' || typeof lat !== 'number') return places.forEach(add);
    [box[0], box[1], box[2], box[3]] = [Math.min(box[0], lon), Math.min(box[1], lat), Math.max(box[2], lon), Math.max(box[3], lat)];
  };
  if ('coordinates' in geometry) add(geometry.coordinates);
  return box;
}
