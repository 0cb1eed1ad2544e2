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
/** With two digits more, which say how much it covers: 0.16, 0.55 and 0.08. */
const fillOf = ({ levels }: MapColours): unknown => byState(`${levels.ready}29`, `${levels.critical}8c`, `${levels.lost}14`);

/** Marked places for cars: by colour, by how full they are, and by a sign. */
export const slots = foundLayer({
  id: 'slots',
  name: 'Parking slots',
  legend: [{ sign: 'area', text: 'a slot: ○ free, × taken, ? nobody knows' }],
  looks: (colours) =>
    [
      // Areas draw their edges themselves: lines of thousands of slots take as long as all the rest of the map.
      { id: 'slots', type: 'fill', paint: { 'fill-color': fillOf(colours), 'fill-outline-color': colourOf(colours) } },
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
