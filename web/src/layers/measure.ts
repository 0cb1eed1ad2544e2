import { metres } from '../lib/format';
import { distanceBetween } from '../lib/places/intent';
import type { Position } from '../lib/protocol';
import { featuresOf, lonLat, type Mark } from './features';
import { BOLD, EMPTY, type MakeLayer } from './layer';

/** How far it is along the places that were clicked at: each leg, and at the last place all of them. */
export const measure: MakeLayer = () => {
  let drawn = '';
  return {
    id: 'measure',
    name: 'Measure',
    group: 'Tools',
    legend: [],
    sources: { measure: EMPTY },
    layers: ({ ground, accent, text }) => [
      { id: 'measure-casing', type: 'line', source: 'measure', paint: { 'line-color': ground, 'line-width': 5.5, 'line-opacity': 0.8 } },
      { id: 'measure', type: 'line', source: 'measure', paint: { 'line-color': accent, 'line-width': 2.5 } },
      {
        id: 'measure-places',
        type: 'circle',
        source: 'measure',
        filter: ['==', ['get', 'kind'], 'place'],
        paint: { 'circle-radius': 4, 'circle-color': ground, 'circle-stroke-color': accent, 'circle-stroke-width': 2 },
      },
      {
        id: 'measure-texts',
        type: 'symbol',
        source: 'measure',
        filter: ['has', 'text'],
        layout: {
          'text-field': ['get', 'text'],
          'text-font': BOLD,
          'text-size': 12.5,
          'text-offset': [0, -1.1],
          'text-allow-overlap': true,
        },
        paint: { 'text-color': text, 'text-halo-color': ground, 'text-halo-width': 2 },
      },
    ],
    update({ generation, measured, source }) {
      const to = source('measure');
      const now = `${generation} ${JSON.stringify(measured)}`;
      if (now === drawn || !to) return;
      to.setData(featuresOf(marksOf(measured)));
      drawn = now;
    },
  };
};

function marksOf(places: readonly Position[]): Mark[] {
  const total = lengthOf(places);
  const ends = places.map((place, index): Mark => {
    const isLast = index > 0 && index === places.length - 1;
    return { properties: { kind: 'place', ...(isLast && { text: lengthText(total) }) }, point: lonLat(place) };
  });
  return [{ properties: {}, line: places.map(lonLat) }, ...ends];
}

export function lengthOf(places: readonly Position[]): number {
  return places.slice(1).reduce((sum, place, index) => sum + distanceBetween(places[index]!, place), 0);
}

export function lengthText(metresLong: number): string {
  return metresLong < 9999.5 ? metres(metresLong) : `${(metresLong / 1000).toFixed(1)} km`;
}
