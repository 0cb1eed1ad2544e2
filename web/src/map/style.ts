import type { LayerSpecification, StyleSpecification } from 'maplibre-gl';
import type { MapLayer } from '../layers/layer';
import type { LayerLook } from '../stores/map_layers.svelte';
import type { BaseStyle } from './base_style';
import type { MapColours } from './colours';

/**
 * The map as its layers want it, on a base map or on nothing: the ground lies below the canvas, where the browser paints it once. As a
 * layer it took a third of the time of each picture that is drawn without a GPU. Text is drawn with the browser's own fonts.
 */
export function mapStyle(
  layers: readonly MapLayer[],
  colours: MapColours,
  base: BaseStyle,
  lookOf: (layer: string) => LayerLook = () => ({ visible: true, opacity: 1 }),
): StyleSpecification {
  return {
    version: 8,
    sources: {
      ...Object.fromEntries(layers.flatMap(({ sources }) => Object.entries(sources))),
      ...base.sources,
    },
    layers: [
      ...base.layers,
      ...layers.flatMap((layer) => layer.layers(colours, base.layers.length > 0).map((one) => looking(one, lookOf(layer.id)))),
    ],
  };
}

/** What of each type of layer tells how clearly it is seen. */
const OPACITIES: Partial<Record<LayerSpecification['type'], readonly string[]>> = {
  line: ['line-opacity'],
  circle: ['circle-opacity', 'circle-stroke-opacity'],
  symbol: ['icon-opacity', 'text-opacity'],
  fill: ['fill-opacity'],
  raster: ['raster-opacity'],
};

/** The opacities of a layer that an operator wants so clear: its own, multiplied. */
export function opacitiesOf(layer: LayerSpecification, opacity: number): Record<string, unknown> {
  const paint = (layer.paint ?? {}) as Record<string, unknown>;
  const faded = (own: unknown): unknown => (own === undefined ? opacity : typeof own === 'number' ? own * opacity : ['*', own, opacity]);
  return Object.fromEntries((OPACITIES[layer.type] ?? []).map((name) => [name, faded(paint[name])]));
}

function looking(layer: LayerSpecification, { visible, opacity }: LayerLook): LayerSpecification {
  const paint = opacity === 1 ? layer.paint : { ...layer.paint, ...opacitiesOf(layer, opacity) };
  return { ...layer, ...(paint && { paint }), layout: { ...layer.layout, visibility: visible ? 'visible' : 'none' } } as LayerSpecification;
}
