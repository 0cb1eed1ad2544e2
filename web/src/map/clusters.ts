import type { LonLat } from './geometry';

/** So many vehicles are shown one by one, however near they are. */
const FEW = 12;
/** So many in one cell of the screen are shown as one. */
const CROWD = 4;
const CELL_PX = 64;
/** Of the whole world at zoom 0. */
const WORLD_PX = 512;

export interface Clustered<T> {
  alone: T[];
  clusters: { at: LonLat; members: T[] }[];
}

/** Those that would lie on each other at that zoom become one; who must be seen stays alone. A cell of the map stays where it is. */
export function clustered<T extends { at: LonLat; mustBeSeen: boolean }>(items: readonly T[], zoom: number): Clustered<T> {
  if (items.length <= FEW) return { alone: [...items], clusters: [] };
  const cells = new Map<string, T[]>();
  const alone: T[] = [];
  const scale = (WORLD_PX * 2 ** zoom) / CELL_PX;
  for (const item of items) {
    if (item.mustBeSeen) {
      alone.push(item);
      continue;
    }
    const [x, y] = mercator(item.at);
    const key = `${Math.floor(x * scale)} ${Math.floor(y * scale)}`;
    const cell = cells.get(key);
    if (cell) cell.push(item);
    else cells.set(key, [item]);
  }
  const clusters: Clustered<T>['clusters'] = [];
  for (const members of cells.values()) {
    if (members.length < CROWD) alone.push(...members);
    else clusters.push({ at: middleOf(members), members });
  }
  return { alone, clusters };
}

/** 0 to 1 from the west and from the north. */
function mercator([lon, lat]: LonLat): [number, number] {
  const y = Math.log(Math.tan(Math.PI / 4 + (lat * Math.PI) / 360));
  return [lon / 360 + 0.5, 0.5 - y / (2 * Math.PI)];
}

function middleOf(members: readonly { at: LonLat }[]): LonLat {
  const sum = members.reduce<LonLat>(([lon, lat], { at }) => [lon + at[0], lat + at[1]], [0, 0]);
  return [sum[0] / members.length, sum[1] / members.length];
}
