import { groundSpeed, type Vehicle } from '../lib/fleet';
import { metres } from '../lib/format';
import { homeDistance, targetOf, targetText } from '../lib/places/intent';
import type { LonLat } from '../map/geometry';
import type { Paper } from '../map/overlay';
import { lonLat } from './features';
import type { MakeLayer } from './layer';
import { paintLine, paintWords } from './paths';

/** Of so many at most: more lines tell nobody anything. */
const MOST = 10;
/** The line ahead is where the vehicle will be after so long, and so long at least. */
const AHEAD_S = 5;
const AHEAD_LEAST_M = 12;
const METRES_PER_DEGREE = 111_319.49;

interface Intent {
  from: LonLat;
  ahead: LonLat | undefined;
  target: { at: LonLat; text: string } | undefined;
  home: { at: LonLat; text: string } | undefined;
}

/** What the selected vehicles are about to do: heading, the way to the target with a flag, the way home. */
export const intents: MakeLayer = ({ fleet, control, layers: content }) => {
  let shown: Intent[] = [];
  let drawn = '';

  function intentOf(vehicle: Vehicle | undefined): Intent[] {
    const { position, home, heading_rad } = vehicle?.fields ?? {};
    if (!vehicle || !position) return [];
    const from = lonLat(position);
    const target = targetOf(vehicle, control.commands, content.plans.get(vehicle.id));
    const distance = homeDistance(vehicle);
    return [
      {
        from,
        ahead:
          heading_rad === undefined ? undefined : ahead(from, heading_rad, Math.max(AHEAD_LEAST_M, (groundSpeed(vehicle) ?? 0) * AHEAD_S)),
        target: target && { at: lonLat(target.place), text: targetText(target) },
        home: home && distance !== undefined && distance > 1 ? { at: lonLat(home), text: `home ${metres(distance)}` } : undefined,
      },
    ];
  }

  return {
    id: 'intents',
    name: 'Where the selected go',
    group: 'Vehicles',
    legend: [{ sign: 'flag', text: 'where a selected vehicle goes: its height there, the way and the time left' }],
    sources: {},
    layers: () => [],
    update({ selected, wantsPaint }) {
      const now = selected.slice(0, MOST).flatMap((id) => intentOf(fleet.get(id)));
      const told = JSON.stringify(now);
      if (told === drawn) return;
      drawn = told;
      shown = now;
      wantsPaint();
    },
    paint(paper) {
      for (const intent of shown) paintIntent(paper, intent);
      return false;
    },
  };
};

function paintIntent(paper: Paper, { from, ahead, target, home }: Intent): void {
  const { colours, place } = paper;
  if (home) {
    paintLine(paper, [from, home.at], { colour: colours.label, width: 1.4, dashes: [2, 4] });
    const [a, b] = [place(from), place(home.at)];
    // Where there is room for it between the two.
    if (Math.hypot(a.x - b.x, a.y - b.y) > 120)
      paintWords(paper, home.text, { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, 'middle', colours.label);
  }
  if (ahead) paintLine(paper, [from, ahead], { colour: colours.text, width: 2 });
  if (!target) return;
  paintLine(paper, [from, target.at], { colour: colours.accent, width: 2, dashes: [7, 4] });
  const { x, y } = place(target.at);
  paintFlag(paper, x, y);
  paintWords(paper, target.text, { x: x + 16, y: y - 4 }, 'corner');
}

const FLAG = 'M0 0V-20L13 -15.500L0 -11';

function paintFlag({ on, colours }: Paper, x: number, y: number): void {
  const flag = new Path2D(FLAG);
  on.save();
  on.translate(x, y);
  on.lineJoin = on.lineCap = 'round';
  on.strokeStyle = colours.ground;
  on.lineWidth = 5;
  on.stroke(flag);
  on.strokeStyle = on.fillStyle = colours.accent;
  on.lineWidth = 2;
  on.fill(flag);
  on.stroke(flag);
  on.restore();
}

function ahead([lon, lat]: LonLat, heading_rad: number, metres: number): LonLat {
  const east = METRES_PER_DEGREE * Math.max(0.01, Math.cos((lat * Math.PI) / 180));
  return [lon + (Math.sin(heading_rad) * metres) / east, lat + (Math.cos(heading_rad) * metres) / METRES_PER_DEGREE];
}
