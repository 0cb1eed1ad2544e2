import type { LayerSpecification, StyleSpecification } from 'maplibre-gl';
import type { MapLayer } from '../layers/layer';
import type { MapColours } from './colours';

/** The map as its layers want it, on a ground of one colour, or on tiles. Text is drawn with the browser's own fonts. */
export function mapStyle(layers: readonly MapLayer[], colours: MapColours, tiles: string): StyleSpecification {
  const tileLayer: LayerSpecification[] = tiles ? [{ id: 'tiles', type: 'raster', source: 'tiles' }] : [];
  return {
    version: 8,
    sources: {
      ...Object.fromEntries(layers.flatMap(({ sources }) => Object.entries(sources))),
      ...(tiles && { tiles: { type: 'raster', tiles: [tiles], tileSize: 256, maxzoom: 19 } }),
    },
    layers: [
      { id: 'ground', type: 'background', paint: { 'background-color': colours.ground } },
      ...tileLayer,
      ...layers.flatMap((layer) => layer.layers(colours, tiles !== '')),
    ],
  };
}
