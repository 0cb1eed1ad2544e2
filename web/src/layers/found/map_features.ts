import type { Feature, Geometry } from 'geojson';
import type { GeoJSONSource } from 'maplibre-gl';
import type { Frame } from '../../connection/frame';
import type { Followed, FeedsStore } from '../../stores/feeds.svelte';

/** Something on the map of a site, as the station tells it: where it lies, and its properties (docs/reference/map.md). */
export interface MapFeature {
  readonly type: 'Feature';
  readonly id: string;
  readonly geometry: Geometry;
  readonly properties: Readonly<Record<string, unknown>>;
}

export type MapFeatures = ReadonlyMap<string, MapFeature>;

/** The layers of features that a station has, by what their feeds are called after `map.`. */
export const FEATURE_LAYERS = ['slots', 'walls', 'points_of_interest', 'pictures', 'areas'] as const;
export type FeatureLayer = (typeof FEATURE_LAYERS)[number];

export function followFeatures(feeds: Readonly<FeedsStore>, layer: FeatureLayer): Followed<MapFeatures> {
  return feeds.follow<MapFeatures>(`map.${layer}`, new Map(), take);
}

/** What is there after a message; a message that is none changes nothing. */
export function take(features: MapFeatures, { content }: Pick<Frame, 'content'>): MapFeatures {
  if (content instanceof Uint8Array || content.type !== 'features') return features;
  const next = new Map(content.full === true ? [] : features);
  for (const id of listOf(content.removed)) if (typeof id === 'string') next.delete(id);
  for (const feature of listOf(content.features)) if (isFeature(feature)) next.set(feature.id, feature);
  return next;
}

function listOf(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

const GEOMETRIES: readonly unknown[] = ['Point', 'LineString', 'Polygon'];

function isFeature(value: unknown): value is MapFeature {
  const { id, geometry, properties } = (value ?? {}) as Partial<MapFeature>;
  const drawn = geometry as { type?: unknown; coordinates?: unknown } | undefined;
  return typeof id === 'string' && typeof properties === 'object' && GEOMETRIES.includes(drawn?.type) && Array.isArray(drawn?.coordinates);
}

export function textOf(feature: MapFeature, property: string): string {
  const value = feature.properties[property];
  return typeof value === 'string' ? value : '';
}

/** Tells a source what has changed in it and nothing else: the map takes a source as a whole, and makes of a difference what it has to. */
export class DrawnFeatures {
  private drawn: MapFeatures = new Map();
  private generation = 0;

  show(source: GeoJSONSource | undefined, generation: number, wanted: MapFeatures): void {
    if (!source) return;
    if (generation !== this.generation) {
      source.setData({ type: 'FeatureCollection', features: [...wanted.values()].map(marked) });
    } else {
      const remove = [...this.drawn.keys()].filter((id) => !wanted.has(id));
      const add = [...wanted].filter(([id, feature]) => this.drawn.get(id) !== feature).map(([, feature]) => marked(feature));
      if (remove.length > 0 || add.length > 0) source.updateData({ remove, add });
    }
    [this.drawn, this.generation] = [wanted, generation];
  }
}

/** The map knows features by a property: an id of text gets lost on the way. */
function marked(feature: MapFeature): Feature {
  return { ...feature, properties: { ...feature.properties, id: feature.id } };
}
