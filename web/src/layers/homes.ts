import type { Marker } from 'maplibre-gl';
import { homeMarker } from '../map/marker';
import { lonLat, placeKey, removeMissing } from './features';
import type { MakeLayer } from './layer';

/** The places to which vehicles return. */
export const homes: MakeLayer = ({ fleet }) => {
  const marks = new Map<string, Marker>();
  return {
    id: 'homes',
    legend: [{ sign: 'letter', text: 'home, to which a vehicle returns' }],
    sources: {},
    layers: () => [],
    update({ map }) {
      const present = new Set<string>();
      for (const { fields } of fleet.vehicles.values()) {
        if (!fields.home) continue;
        const key = placeKey(fields.home);
        present.add(key);
        if (!marks.has(key)) marks.set(key, homeMarker(map, lonLat(fields.home)));
      }
      removeMissing(marks, (key) => present.has(key));
    },
  };
};
