import type { LayerSpecification } from 'maplibre-gl';
import { TrailPieces } from './trail_pieces';
import { COLOUR, EMPTY, type MakeLayer } from './layer';

/**
 * Where the vehicles have been. A map takes a source as a whole and draws it anew, so what grows by a point must not lie in one with
 * 150,000 others: the ends of the trails, which grow, have a small source of their own, and what has gathered there moves over to
 * the large one now and then, in pieces that are sent once.
 */
export const trails: MakeLayer = ({ layers: content }) => {
  const pieces = new TrailPieces();
  let drawn = '';
  let drawnOn = '';
  return {
    id: 'trails',
    legend: [{ sign: 'line', text: 'where a vehicle has been' }],
    sources: { trails: { ...EMPTY, tolerance: 0.1 }, 'trail-ends': EMPTY },
    layers: () => ['trails', 'trail-ends'].map(line),
    update({ generation, colourOf, source }) {
      const known = [...content.trails.entries()];
      const ground = [generation, ...known.map(([id]) => colourOf(id))].join();
      const now = `${content.trailRevision} ${ground}`;
      const [settled, ends] = [source('trails'), source('trail-ends')];
      if (!settled || !ends || now === drawn) return;
      const isAnew = ground !== drawnOn;
      [drawn, drawnOn] = [now, ground];
      if (isAnew || pieces.wantSettling(known)) settled.updateData(pieces.settle(known, colourOf, isAnew));
      ends.setData(pieces.ends(known, colourOf));
    },
  };
};

function line(source: string): LayerSpecification {
  return {
    id: source,
    type: 'line',
    source,
    // No round ends: where two pieces meet they would lie on each other, and be seen as a dot.
    layout: { 'line-join': 'round' },
    paint: { 'line-color': COLOUR, 'line-width': 3, 'line-opacity': 0.55 },
  };
}
