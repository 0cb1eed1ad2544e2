import type { Geometry } from 'geojson';
import type { MapFeature } from '../../layers/found/map_features';
import { boundsOf, cover, type Bounds } from '../../map/geometry';
import type { Position } from '../protocol';
import { siteToMap } from './sites';
import { viewAxis, type ViewAxis } from './view_axis';

/** What something that was found is called, by the first of its names that it has. */
export function nameOf({ id, properties }: MapFeature): string {
  for (const key of ['name', 'kind']) {
    const value = properties[key];
    if (typeof value === 'string' && value !== '') return value;
  }
  return id;
}

function positionsOf(geometry: Geometry): Position[] {
  if (geometry.type === 'GeometryCollection') return [];
  const places: Position[] = [];
  const walk = (value: unknown): void => {
    if (!Array.isArray(value)) return;
    const [lon, lat] = value as unknown[];
    if (typeof lon === 'number' && typeof lat === 'number') places.push({ lon_deg: lon, lat_deg: lat, alt_m: 0 });
    else for (const part of value) walk(part);
  };
  walk(geometry.coordinates);
  return places;
}

/** What a map has to show to show it. */
export function extentOf({ geometry }: MapFeature, leastSpan_m = 20): Bounds | undefined {
  return boundsOf(positionsOf(geometry), leastSpan_m);
}

/** What a map has to show to show all of it. */
export function extentOfAll(features: Iterable<MapFeature>): Bounds | undefined {
  let all: Bounds | undefined;
  for (const feature of features) {
    const one = extentOf(feature);
    all = all && one ? cover(all, one) : (all ?? one);
  }
  return all;
}

const numberOf = ({ properties }: MapFeature, key: string): number | undefined => {
  const value = properties[key];
  return typeof value === 'number' && Number.isFinite(value) ? value : undefined;
};

/** From where a picture was taken, and where the camera looked, as far as the picture says. */
export function poseOf(feature: MapFeature, anchor: Position | undefined): { from?: Position; up_m?: number; axis?: ViewAxis } {
  const [x, y, z, w] = ['camera_qx', 'camera_qy', 'camera_qz', 'camera_qw'].map((key) => numberOf(feature, key));
  const turn = x !== undefined && y !== undefined && z !== undefined && w !== undefined ? viewAxis({ x, y, z, w }) : undefined;
  const up_m = numberOf(feature, 'up_m');
  const from = placeOf(feature, anchor);
  return { ...(from && { from }), ...(up_m !== undefined && { up_m }), ...(turn && { axis: turn }) };
}

function placeOf(feature: MapFeature, anchor: Position | undefined): Position | undefined {
  const { geometry } = feature;
  if (geometry.type === 'Point') return positionsOf(geometry)[0];
  const [x_m, y_m] = [numberOf(feature, 'camera_x_m'), numberOf(feature, 'camera_y_m')];
  if (!anchor || x_m === undefined || y_m === undefined) return undefined;
  return siteToMap({ site: '', x_m, y_m, z_m: 0, yaw_rad: 0 }, anchor);
}

/** Those whose name, kind, text or id has all of the words, the best known first. */
export function search(features: Iterable<MapFeature>, words: string): MapFeature[] {
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const textOf = ({ id, properties: { name, kind, text } }: MapFeature): string => [name, kind, text, id].join(' ').toLowerCase();
  return [...features]
    .filter((feature) => wanted.every((word) => textOf(feature).includes(word)))
    .sort((a, b) => nameOf(a).localeCompare(nameOf(b), undefined, { numeric: true }));
}
