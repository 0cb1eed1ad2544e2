import type { MapColours } from '../../map/colours';
import { FONT } from '../layer';
import { foundLayer } from './found_layer';

const colourOf = ({ accent, levels }: MapColours): unknown => [
  'match',
  ['get', 'purpose'],
  'no_go',
  levels.critical,
  'fence',
  levels.warning,
  accent,
];

/** Where vehicles shall look, must stay, or must not go. */
export const areas = foundLayer({
  id: 'areas',
  name: 'Areas',
  legend: [{ sign: 'dashes', text: 'an area that is wanted, a fence, or one where nobody may go' }],
  looks: (colours) =>
    [
      {
        id: 'areas-fill',
        type: 'fill',
        paint: { 'fill-color': colourOf(colours), 'fill-opacity': ['match', ['get', 'purpose'], 'no_go', 0.2, 0.06] },
      },
      { id: 'areas-line', type: 'line', paint: { 'line-color': colourOf(colours), 'line-width': 2, 'line-dasharray': [3, 2] } },
      {
        id: 'areas-name',
        type: 'symbol',
        minzoom: 15,
        layout: { 'text-field': ['coalesce', ['get', 'name'], ''], 'text-font': FONT, 'text-size': 12 },
        paint: { 'text-color': colours.text, 'text-halo-color': colours.panel, 'text-halo-width': 1.4 },
      },
    ] as never,
});
