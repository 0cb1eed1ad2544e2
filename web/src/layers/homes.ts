import type { Position } from '../lib/protocol';
import { HOME_ICON } from '../map/icons';
import { featuresOf, lonLat, placeKey } from './features';
import { EMPTY, type MakeLayer } from './layer';

/** The places to which vehicles return. */
export const homes: MakeLayer = ({ fleet }) => {
  let drawn = '';
  return {
    id: 'homes',
    name: 'Homes',
    group: 'Vehicles',
    legend: [{ sign: 'letter', text: 'home, to which a vehicle returns' }],
    sources: { homes: EMPTY },
    layers: () => [{ id: 'homes', type: 'symbol', source: 'homes', layout: { 'icon-image': HOME_ICON, 'icon-allow-overlap': true } }],
    update({ generation, source }) {
      const places = new Map<string, Position>();
      for (const { fields } of fleet.vehicles.values()) if (fields.home) places.set(placeKey(fields.home), fields.home);
      const now = [generation, ...places.keys()].join();
      const to = source('homes');
      if (now === drawn || !to) return;
      to.setData(featuresOf([...places.values()].map((place) => ({ properties: {}, point: lonLat(place) }))));
      drawn = now;
    },
  };
};
