import type { LayerSpecification } from 'maplibre-gl';
import type { LonLat } from '../map/geometry';
import { TrailPieces } from './trail_pieces';
import { COLOUR, EMPTY, type MakeLayer } from './layer';
import { paintLine } from './paths';

const WIDTH_PX = 2.6;

/**
 * Where the vehicles have been. The map takes a source as a whole and is drawn anew for it, so what grows by a point must not lie in one
 * with 150,000 others: the ends of the trails, which grow, are painted above the map, and what has gathered there moves over to it now
 * and then, in pieces that are sent once.
 */
export const trails: MakeLayer = ({ layers: content }) => {
  const pieces = new TrailPieces();
  let ends: { colour: string; line: readonly LonLat[] }[] = [];
  let drawn = '';
  let drawnOn = '';
  return {
    id: 'trails',
    name: 'Trails',
    group: 'Paths',
    legend: [{ sign: 'line', text: 'where a vehicle has been' }],
    sources: { trails: EMPTY },
    layers: ({ ground }, hasTiles) => [casing(ground, hasTiles), line()],
    update({ generation, colourOf, source, wantsPaint }) {
      const known = [...content.trails.entries()];
      const ground = [generation, ...known.map(([id]) => colourOf(id))].join();
      const now = `${content.trailRevision} ${ground}`;
      const settled = source('trails');
      if (!settled || now === drawn) return;
      const isAnew = ground !== drawnOn;
      [drawn, drawnOn] = [now, ground];
      if (isAnew || pieces.wantSettling(known)) settled.updateData(pieces.settle(known, colourOf, isAnew));
      ends = pieces.ends(known, colourOf);
      wantsPaint();
    },
    paint(paper) {
      for (const { colour, line } of ends) paintLine(paper, line, { colour, width: WIDTH_PX, opacity: 0.9 });
      return false;
    },
  };
};

// No round ends: where two pieces meet they would lie on each other, and be seen as a dot.
const layout = { 'line-join': 'round' } as const;

/** In wider views than this, without a base map, nothing lies below trails from which a casing would set them off. */
const NEAR_ZOOM = 15;

/** Below the line, to be seen on pictures, too. */
function casing(ground: string, hasTiles: boolean): LayerSpecification {
  return {
    id: 'trail-casings',
    type: 'line',
    source: 'trails',
    minzoom: hasTiles ? 0 : NEAR_ZOOM,
    layout,
    paint: { 'line-color': ground, 'line-width': WIDTH_PX + 2.4, 'line-opacity': 0.65 },
  };
}

function line(): LayerSpecification {
  return {
    id: 'trails',
    type: 'line',
    source: 'trails',
    layout,
    paint: { 'line-color': COLOUR, 'line-width': WIDTH_PX, 'line-opacity': 0.9 },
  };
}
