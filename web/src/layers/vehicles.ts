import { rankOf } from '../lib/attention';
import type { Vehicle } from '../lib/fleet';
import { metres } from '../lib/format';
import { isOld, statusOf, type Level } from '../lib/status';
import { clustered } from '../map/clusters';
import type { LonLat } from '../map/geometry';
import { Glide } from '../map/glide';
import { badgeIcon, vehicleIcon } from '../map/icons';
import { labelsToShow, type Box, type Wish } from '../map/labels';
import type { Paper, Point } from '../map/overlay';
import type { Stamp } from '../map/stamps';
import { lonLat } from './features';
import type { Drawing, Hit, MakeLayer } from './layer';

const ICON_PX = 36;
const RING_PX = 21;
const CROWD_PX = 17;
/** From the middle of a vehicle to its label. */
const LABEL_PX = 20;
/** What lies further outside is not drawn. */
const MARGIN_PX = 120;

/** A vehicle as it is drawn. */
interface Mark {
  id: string;
  at: LonLat;
  icon: string;
  badge: string;
  turn: number;
  name: string;
  detail: string;
  colour: string;
  level: Level;
  isSelected: boolean;
  mustBeSeen: boolean;
  rank: number;
}

/** Several vehicles as one; the worst of them gives it its colour. */
interface Crowd {
  at: LonLat;
  ids: string[];
  level: Level;
}

/** The vehicles: an icon each, turned to where it heads; labels that thin out where there is no room, who needs attention last. */
export const vehicles: MakeLayer = ({ fleet, session }) => {
  const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');
  const glide = new Glide();
  let marks: Mark[] = [];
  let crowds: Crowd[] = [];
  let labelled: ReadonlySet<string> = new Set();
  let drawn = '';

  function markOf(vehicle: Vehicle, selected: ReadonlySet<string>, colour: string): Mark[] {
    const { id, fields } = vehicle;
    if (!fields.position) return [];
    const isSelected = selected.has(id);
    const status = statusOf(vehicle, session.isLost, fleet.batteryLimits);
    return [
      {
        id,
        at: lonLat(fields.position),
        icon: vehicleIcon(fields.family ?? 'unknown', status.level),
        badge: badgeIcon(status.level),
        turn: fields.heading_rad ?? 0,
        name: fields.name || id,
        detail: detailOf(vehicle),
        colour,
        level: status.level,
        isSelected,
        mustBeSeen: isSelected,
        rank: isSelected ? -1 : rankOf(status),
      },
    ];
  }

  function paint(paper: Paper, now: number): boolean {
    const shown = marks
      .map((mark) => ({ mark, on: paper.place(glide.at(mark.id, now) ?? mark.at) }))
      .filter(({ on }) => on.x > -MARGIN_PX && on.y > -MARGIN_PX && on.x < paper.width + MARGIN_PX && on.y < paper.height + MARGIN_PX);
    // Who needs attention lies above the others.
    shown.sort((a, b) => b.mark.rank - a.mark.rank);
    labelled = paintLabels(paper, shown, labelled);
    for (const { mark, on } of shown) paintVehicle(paper, mark, on);
    for (const crowd of crowds) paintCrowd(paper, crowd);
    return glide.goesOn(now);
  }

  return {
    id: 'vehicles',
    name: 'Vehicles',
    group: 'Vehicles',
    legend: [
      { sign: 'shape', text: 'a vehicle, its shape that of its family, turned to where it heads; its colour is its state' },
      { sign: 'ring', text: 'several vehicles side by side, and the worst state among them: a click goes nearer' },
    ],
    sources: {},
    layers: () => [],
    update({ generation, zoom, selected, colourOf, wantsPaint }) {
      const chosen = new Set(selected);
      const all = [...fleet.vehicles.values()].flatMap((vehicle) => markOf(vehicle, chosen, colourOf(vehicle.id)));
      const now = `${generation} ${zoom} ${JSON.stringify(all)}`;
      if (now === drawn) return;
      drawn = now;
      const { alone, clusters } = clustered(all, zoom);
      [marks, crowds] = [alone, clusters.map(crowdOf)];
      const begun = performance.now();
      for (const { id, at } of alone) glide.moveTo(id, at, begun, !reducedMotion.matches);
      glide.keepOnly((id) => fleet.vehicles.has(id));
      wantsPaint();
    },
    paint,
    hit: (place, within, drawing) => nearest([...marks.map(({ id, at }) => ({ ids: [id], at })), ...crowds], place, within, drawing),
  };
};

function crowdOf({ at, members }: { at: LonLat; members: Mark[] }): Crowd {
  const worst = members.reduce((a, b) => (b.rank < a.rank ? b : a));
  return { at, ids: members.map(({ id }) => id), level: worst.level };
}

function nearest(
  shown: readonly { ids: readonly string[]; at: LonLat }[],
  { x, y }: Point,
  within: number,
  { map }: Drawing,
): Hit | undefined {
  let best: Hit | undefined;
  for (const { at, ids } of shown) {
    const on = map.project(at);
    const distance = Math.hypot(on.x - x, on.y - y);
    if (distance <= (best?.distance ?? within)) best = { vehicles: ids, at, distance };
  }
  return best;
}

function detailOf(vehicle: Vehicle): string {
  const { mode, relative_alt_m: height } = vehicle.fields;
  const isHigh = height !== undefined && Math.abs(height) > 0.5;
  return [isOld(vehicle) && 'last known', mode, isHigh && metres(height)].filter(Boolean).join(' · ');
}

interface Placed {
  mark: Mark;
  on: Point;
}

/** The labels that have room; which they are. */
function paintLabels({ on: context, colours, stamps, taken }: Paper, shown: readonly Placed[], before: ReadonlySet<string>): Set<string> {
  const texts = new Map<string, { name: Stamp; detail: Stamp | undefined }>();
  const wishes = shown.map(({ mark, on }): Wish => {
    const name = stamps.text(mark.name, 12.5, 650, colours.text);
    const detail = mark.detail ? stamps.text(mark.detail, 11.5, 400, colours.label) : undefined;
    texts.set(mark.id, { name, detail });
    const width = Math.max(name.width, detail?.width ?? 0);
    return {
      id: mark.id,
      left: on.x - width / 2,
      top: on.y + LABEL_PX,
      width,
      height: name.height + (detail?.height ?? 0) - 3,
      rank: mark.rank,
    };
  });
  const icons = new Map(shown.map(({ mark, on }): [string, Box] => [mark.id, { left: on.x - 13, top: on.y - 13, width: 26, height: 26 }]));
  taken.forEach((box, index) => icons.set(`words ${index}`, box));
  const free = labelsToShow(wishes, icons, before);
  for (const { mark, on } of shown) {
    const { name, detail } = texts.get(mark.id)!;
    if (!free.has(mark.id)) continue;
    const top = on.y + LABEL_PX;
    if (detail) context.drawImage(detail.image, on.x - detail.width / 2, top + name.height - 3, detail.width, detail.height);
    context.drawImage(name.image, on.x - name.width / 2, top, name.width, name.height);
    // The colour of its paths.
    context.fillStyle = mark.colour;
    context.fillRect(on.x - name.width / 2 - 2, top + 3, 3, name.height - 5);
  }
  return free;
}

function paintVehicle({ on: context, colours, stamps }: Paper, { icon, badge, turn, level, isSelected }: Mark, { x, y }: Point): void {
  if (isSelected) {
    context.fillStyle = `${colours.levels[level]}2e`;
    circle(context, x, y, RING_PX);
    context.fill();
    context.strokeStyle = colours.levels[level];
    context.lineWidth = 2.5;
    context.stroke();
  }
  context.save();
  context.translate(x, y);
  context.rotate(turn);
  context.drawImage(stamps.icon(icon).image, -ICON_PX / 2, -ICON_PX / 2, ICON_PX, ICON_PX);
  context.restore();
  if (!badge) return;
  const { image, width } = stamps.icon(badge);
  context.drawImage(image, x + 5, y - 23, width, width);
}

function paintCrowd({ on: context, colours, stamps, place }: Paper, { at, ids, level }: Crowd): void {
  const { x, y } = place(at);
  context.fillStyle = colours.panel;
  circle(context, x, y, CROWD_PX);
  context.fill();
  context.strokeStyle = colours.levels[level];
  context.lineWidth = 3.5;
  context.stroke();
  const { image, width, height } = stamps.text(String(ids.length), 13, 700, colours.text);
  context.drawImage(image, x - width / 2, y - height / 2, width, height);
}

function circle(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}
