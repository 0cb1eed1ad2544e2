import type { MapColours } from '../../map/colours';
import { FONT } from '../layer';
import { foundLayer } from './found_layer';

const byState = (free: unknown, taken: unknown, unknown: unknown): unknown => [
  'match',
  ['coalesce', ['get', 'state'], 'unknown'],
  'free',
  free,
  'taken',
  taken,
  unknown,
];
const colourOf = ({ levels }: MapColours): unknown => byState(levels.ready, levels.critical, levels.lost);

/** Marked places for cars: by colour, by how full they are, and by a sign. */
export const slots = foundLayer({
  id: 'slots',
  name: 'Parking slots',
  legend: [{ sign: 'area', text: 'a slot: ○ free, × taken, ? nobody knows' }],
  looks: (colours) =>
    [
      {
        id: 'slots-fill',
        type: 'fill',
        paint: { 'fill-antialias': false, 'fill-color': colourOf(colours), 'fill-opacity': byState(0.16, 0.55, 0.08) },
      },
      { id: 'slots-line', type: 'line', minzoom: 16, paint: { 'line-color': colourOf(colours), 'line-width': 1.2 } },
      {
        id: 'slots-sign',
        type: 'symbol',
        minzoom: 18.5,
        layout: {
          'text-field': ['concat', byState('○', '×', '?'), ['case', ['has', 'name'], ['concat', '\n', ['get', 'name']], '']],
          'text-font': FONT,
          'text-size': 12,
        },
        paint: { 'text-color': colours.text, 'text-halo-color': colours.panel, 'text-halo-width': 1.2 },
      },
    ] as never,
});
