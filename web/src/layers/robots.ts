import { ellipseOf, sketchesOf, type RobotSketch } from '../lib/places/robot_sketch';
import type { LonLat } from '../map/geometry';
import type { Paper } from '../map/overlay';
import type { MakeLayer } from './layer';
import { paintLine } from './paths';

/** As large as a step on the ground, within what can be seen and does not cover the floor. */
const FRONTIER_M = 0.4;
const FRONTIER_PX = { least: 1, most: 4 };
const METRES_PER_DEGREE = 111_320;

interface Shown {
  sketch: RobotSketch;
  ellipse: LonLat[];
  colour: string;
}

/** What robots that map a floor intend: the way ahead, where their map is open, and how sure they are of their place. */
export const robots: MakeLayer = ({ feeds, fleet }) => {
  const told = feeds.follow<readonly RobotSketch[]>('robots', [], (_, { content }) => sketchesOf(content));
  let shown: Shown[] = [];
  let drawn = '';

  return {
    id: 'robots',
    name: 'Where robots look next',
    group: 'Paths',
    legend: [
      { sign: 'dashes', text: 'the way that a robot follows' },
      { sign: 'dot', text: 'an open frontier: unknown lies behind' },
      { sign: 'ring', text: 'where a robot is, 19 of 20 times' },
    ],
    sources: {},
    layers: () => [],
    update({ colourOf, wantsPaint }) {
      const now = told.content.map((sketch) => {
        const position = fleet.get(sketch.id)?.fields.position;
        const ellipse = position && sketch.spread ? ellipseOf(sketch.spread, position) : [];
        return { sketch, ellipse, colour: colourOf(sketch.id) };
      });
      const text = JSON.stringify(now);
      if (text === drawn) return;
      drawn = text;
      shown = now;
      wantsPaint();
    },
    paint(paper) {
      for (const one of shown) paintSketch(paper, one);
      return false;
    },
  };
};

function paintSketch(paper: Paper, { sketch: { way, frontiers }, ellipse, colour }: Shown): void {
  const { on, colours, place } = paper;
  paintLine(paper, ellipse, { colour, width: 1.4 });
  paintLine(paper, way, { colour, width: 2, dashes: [5, 4] });
  const [first] = frontiers;
  if (!first) return;
  const metre = place(first).y - place([first[0], first[1] + 1 / METRES_PER_DEGREE]).y;
  const radius = Math.min(Math.max(FRONTIER_M * metre, FRONTIER_PX.least), FRONTIER_PX.most);
  on.fillStyle = colours.levels.warning;
  on.strokeStyle = colours.ground;
  on.lineWidth = radius / 3;
  for (const at of frontiers) {
    const { x, y } = place(at);
    on.beginPath();
    on.arc(x, y, radius, 0, 2 * Math.PI);
    on.fill();
    on.stroke();
  }
}
