import { destinationsOf, type Destination } from '../lib/commands';
import { DestinationMarker } from '../map/marker';
import type { LonLat } from '../map/geometry';
import type { StoresToRead } from '../stores/stores';
import { lonLat, placeKey, removeMissing } from './features';
import type { Drawing, MakeLayer } from './layer';
import { paintLine } from './paths';

interface Way {
  colour: string;
  line: [LonLat, LonLat];
}

/** Where vehicles were sent, the way to it, and what is left of the way. */
export const destinations: MakeLayer = (stores) => {
  const marks = new Map<string, DestinationMarker>();
  let ways: Way[] = [];

  return {
    id: 'destinations',
    name: 'Places where vehicles were sent',
    group: 'Paths',
    legend: [{ sign: 'dot', text: 'the place where a vehicle was sent, and what is left of the way' }],
    sources: {},
    layers: () => [],
    update(drawing) {
      const bound = destinationsOf(stores.control.commands);
      showMarks(bound, marks, stores, drawing);
      if (bound.length === 0 && ways.length === 0) return;
      ways = bound.flatMap(({ vehicle, place }): Way[] => {
        const from = stores.fleet.get(vehicle)?.fields.position;
        return from ? [{ colour: drawing.colourOf(vehicle), line: [lonLat(from), lonLat(place)] }] : [];
      });
      drawing.wantsPaint();
    },
    paint(paper) {
      for (const { colour, line } of ways) paintLine(paper, line, { colour, width: 2.4 });
      return false;
    },
    hide: () => removeMissing(marks, () => false),
  };
};

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
