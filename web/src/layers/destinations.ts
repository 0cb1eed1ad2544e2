import type { LayerSpecification } from 'maplibre-gl';
import { destinationsOf, type Destination } from '../lib/commands';
import type { Position } from '../lib/protocol';
import { DestinationMarker } from '../map/marker';
import type { StoresToRead } from '../stores/stores';
import { lonLat, pathFeatures, placeKey, removeMissing } from './features';
import { COLOUR, EMPTY, type Drawing, type MakeLayer } from './layer';

/** Where vehicles were sent, the way to it, and what is left of the way. */
export const destinations: MakeLayer = (stores) => {
  const marks = new Map<string, DestinationMarker>();
  let drawn = { generation: 0, lines: 0 };

  function drawWays(bound: Destination[], { generation, colourOf, source }: Drawing): void {
    const ways = new Map<string, Position[]>();
    for (const { vehicle, place } of bound) {
      const from = stores.fleet.get(vehicle)?.fields.position;
      if (from) ways.set(vehicle, [from, place]);
    }
    // Nothing in place of nothing would paint the whole map again.
    if (ways.size === 0 && drawn.lines === 0 && drawn.generation === generation) return;
    drawn = { generation, lines: ways.size };
    source('destinations')?.setData(pathFeatures(ways, colourOf));
  }

  return {
    id: 'destinations',
    legend: [{ sign: 'dot', text: 'the place where a vehicle was sent, and what is left of the way' }],
    sources: { destinations: EMPTY },
    layers: ({ ground }) => lines(ground),
    update(drawing) {
      const bound = destinationsOf(stores.control.commands);
      showMarks(bound, marks, stores, drawing);
      if (drawing.generation > 0) drawWays(bound, drawing);
    },
  };
};

/** Cased, to be seen on any ground. */
function lines(ground: string): LayerSpecification[] {
  const line = { type: 'line', source: 'destinations', layout: { 'line-cap': 'round' } } as const;
  return [
    { id: 'destination-casings', ...line, paint: { 'line-color': ground, 'line-width': 5, 'line-opacity': 0.8 } },
    { id: 'destinations', ...line, paint: { 'line-color': COLOUR, 'line-width': 2.4 } },
  ];
}

/** Vehicles that were sent to one place share its mark. */
function showMarks(bound: Destination[], marks: Map<string, DestinationMarker>, { fleet }: StoresToRead, { map }: Drawing): void {
  const byPlace = new Map<string, Destination[]>();
  for (const one of bound) {
    const key = placeKey(one.place);
    byPlace.set(key, [...(byPlace.get(key) ?? []), one]);
  }
  for (const [key, sharing] of byPlace) {
    const mark = marks.get(key) ?? new DestinationMarker(map, lonLat(sharing[0]!.place));
    marks.set(key, mark);
    const names = sharing.map(({ vehicle }) => fleet.nameOf(vehicle));
    const text = sharing.map(({ left }, index) => (sharing.length > 1 ? `${names[index]} ${left}` : left));
    mark.show(text.slice(0, 3).join(', ') + (text.length > 3 ? ` and ${text.length - 3} more` : ''), names.join(', '));
  }
  removeMissing(marks, (key) => byPlace.has(key));
}
