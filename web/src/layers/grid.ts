import type { LayerSpecification } from 'maplibre-gl';
import { gridLines } from '../map/geometry';
import type { MapColours } from '../map/colours';
import { featuresOf } from './features';
import { EMPTY, type MakeLayer } from './layer';

const LINES_A_SIDE = 12;

/** Metres from the origin of the field; in wide views the graticule. */
export const grid: MakeLayer = ({ layers: content }) => ({
  id: 'grid',
  name: 'Grid',
  group: 'Ground',
  legend: [{ sign: 'grid', text: 'metres north and east of home; in wide views degrees' }],
  sources: { grid: EMPTY },
  layers: (colours, hasTiles) => [lines(colours, hasTiles), labels(colours)],
  update({ generation, view, source }) {
    if (generation === 0) return;
    const found = gridLines(view, content.origin, LINES_A_SIDE);
    const features = found.map(({ points, label, major }) => ({ properties: { label, major }, line: points }));
    source('grid')?.setData(featuresOf(features));
  },
});

function lines({ major, minor }: MapColours, hasTiles: boolean): LayerSpecification {
  return {
    id: 'grid',
    type: 'line',
    source: 'grid',
    paint: {
      'line-color': ['case', ['get', 'major'], major, minor],
      'line-width': ['case', ['get', 'major'], 1.2, 1],
      'line-opacity': hasTiles ? 0.45 : 1,
    },
  };
}

function labels({ ground, label }: MapColours): LayerSpecification {
  return {
    id: 'grid-labels',
    type: 'symbol',
    source: 'grid',
    layout: {
      'symbol-placement': 'line',
      'symbol-spacing': 640,
      'text-field': ['get', 'label'],
      'text-font': ['system-ui', 'sans-serif'],
      'text-size': 11,
      'text-padding': 12,
    },
    paint: { 'text-color': label, 'text-halo-color': ground, 'text-halo-width': 2 },
  };
}
