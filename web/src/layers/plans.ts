import { pathFeatures } from './features';
import { COLOUR, EMPTY, type MakeLayer } from './layer';

/** Where each vehicle is to go by its mission. */
export const plans: MakeLayer = ({ layers: content }) => ({
  id: 'plans',
  name: 'Planned paths',
  group: 'Paths',
  legend: [{ sign: 'dashes', text: 'the path that a mission plans' }],
  sources: { plans: EMPTY },
  layers: ({ ground }) => [
    {
      id: 'plan-casings',
      type: 'line',
      source: 'plans',
      filter: ['==', ['geometry-type'], 'LineString'],
      layout: { 'line-join': 'round' },
      paint: { 'line-color': ground, 'line-width': 4, 'line-opacity': 0.6 },
    },
    {
      id: 'plans',
      type: 'line',
      source: 'plans',
      filter: ['==', ['geometry-type'], 'LineString'],
      layout: { 'line-join': 'round' },
      paint: { 'line-color': COLOUR, 'line-width': 1.8, 'line-dasharray': [3, 2.5], 'line-opacity': 0.9 },
    },
    {
      id: 'plan-points',
      type: 'circle',
      source: 'plans',
      minzoom: 15,
      paint: { 'circle-radius': 2.4, 'circle-color': COLOUR, 'circle-opacity': 0.85 },
    },
  ],
  update({ generation, colourOf, source }) {
    if (generation > 0) source('plans')?.setData(pathFeatures(content.plans, colourOf));
  },
});
