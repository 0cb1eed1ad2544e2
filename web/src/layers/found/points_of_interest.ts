import { BOLD } from '../layer';
import { foundLayer } from './found_layer';

/** Small in wide views, where hundreds would cover what they stand on. */
const growing = (small: number, large: number): unknown => ['interpolate', ['linear'], ['zoom'], 15, small, 18, large];

/** Doors, name tags and whatever else somebody points to. */
export const pointsOfInterest = foundLayer({
  id: 'points_of_interest',
  name: 'Points of interest',
  legend: [{ sign: 'dot', text: 'a door, a name tag: click it to see its picture and text' }],
  looks: ({ accent, panel, text }) =>
    [
      {
        id: 'poi-dot',
        type: 'circle',
        paint: {
          'circle-radius': growing(2.5, 6),
          'circle-color': accent,
          'circle-stroke-color': panel,
          'circle-stroke-width': growing(0.6, 2),
        },
      },
      {
        id: 'poi-name',
        type: 'symbol',
        minzoom: 17,
        layout: {
          'text-field': ['coalesce', ['get', 'name'], ['get', 'kind'], ''],
          'text-font': BOLD,
          'text-size': 12,
          'text-anchor': 'left',
          'text-offset': [0.8, 0],
          'text-optional': true,
        },
        paint: { 'text-color': text, 'text-halo-color': panel, 'text-halo-width': 1.6 },
      },
    ] as never,
});
