import type { Feature, FeatureCollection } from 'geojson';
import { gridLines, MAP_END_DEG, type Bounds, type LonLat } from '../lib/geometry';
import type { Position } from '../lib/protocol';

/** On the map, which ends before the poles. */
export function lonLat(position: Position): LonLat {
  return [position.lon_deg, Math.max(-MAP_END_DEG, Math.min(MAP_END_DEG, position.lat_deg))];
}

/** One line a vehicle, coloured as it is. */
export function pathFeatures(paths: Map<string, Position[]>, colourOf: (id: string) => string): FeatureCollection {
  const features: Feature[] = [];
  for (const [id, path] of paths) {
    if (path.length < 2) continue;
    const coordinates = path.map(lonLat);
    features.push({ type: 'Feature', properties: { id, colour: colourOf(id) }, geometry: { type: 'LineString', coordinates } });
  }
  return { type: 'FeatureCollection', features };
}

/** One dot a place, coloured as its vehicle is. */
export function pointFeatures(places: Map<string, Position[]>, colourOf: (id: string) => string): FeatureCollection {
  const features = [...places].flatMap(([id, points]) =>
    points.map((point): Feature => ({
      type: 'Feature',
      properties: { colour: colourOf(id) },
      geometry: { type: 'Point', coordinates: lonLat(point) },
    })),
  );
  return { type: 'FeatureCollection', features };
}

export function gridFeatures(view: Bounds, origin: Position | undefined): FeatureCollection {
  const features = gridLines(view, origin, 12).map(({ points, label, major }): Feature => ({
    type: 'Feature',
    properties: { label, major },
    geometry: { type: 'LineString', coordinates: points },
  }));
  return { type: 'FeatureCollection', features };
}
