import { FAMILY_WORDS } from '../map/shapes';
import type { Vehicle } from './fleet';
import { statusOf, type BatteryLimits, type Level, type Status } from './status';

/** Who needs somebody first comes first. Silence is worse than a warning: nobody knows what goes on there. */
const RANKS: Record<Level, number> = { critical: 0, lost: 1, warning: 2, active: 3, ready: 4 };
const LEVEL_WORDS: Record<Level, string> = {
  critical: 'Critical',
  lost: 'Not heard',
  warning: 'Warning',
  active: 'Active',
  ready: 'Ready',
};

export const rankOf = ({ level }: Status): number => RANKS[level];

export type Grouping = 'none' | 'kind' | 'state';
export type Order = 'attention' | 'id';

/** A line of the fleet: a vehicle, or the head of a group. */
export type Entry = { kind: 'head'; id: string; title: string; count: number } | { kind: 'vehicle'; id: string };

interface Judged {
  vehicle: Vehicle;
  status: Status;
}

/** Each of the words occurs in what the fleet tells of the vehicle. */
function matches({ vehicle: { id, fields }, status }: Judged, words: string[]): boolean {
  const told = [id, fields.name, fields.family, fields.mode, status.word, fields.control?.commander].join(' ').toLowerCase();
  return words.every((word) => told.includes(word));
}

export interface Arrangement {
  words: string;
  grouping: Grouping;
  order: Order;
}

/** The fleet as it is listed: those that match, in groups, who needs attention first. Vehicles come in the order of their ids. */
export function arrange(
  vehicles: Iterable<Vehicle>,
  { words, grouping, order }: Arrangement,
  judge: (vehicle: Vehicle) => Status,
): Entry[] {
  const sought = words.toLowerCase().split(/\s+/).filter(Boolean);
  const judged = [...vehicles].map((vehicle) => ({ vehicle, status: judge(vehicle) })).filter((one) => matches(one, sought));
  if (order === 'attention') judged.sort((a, b) => rankOf(a.status) - rankOf(b.status));
  if (grouping === 'none') return judged.map(({ vehicle }) => ({ kind: 'vehicle', id: vehicle.id }));
  const titleOf = ({ vehicle, status }: Judged): string =>
    grouping === 'kind' ? capital(FAMILY_WORDS[vehicle.fields.family ?? 'unknown']) : LEVEL_WORDS[status.level];
  const groups = new Map<string, Entry[]>();
  for (const one of judged) {
    const members = groups.get(titleOf(one)) ?? [];
    members.push({ kind: 'vehicle', id: one.vehicle.id });
    groups.set(titleOf(one), members);
  }
  return [...groups].flatMap(([title, members]) => [{ kind: 'head', id: `group ${title}`, title, count: members.length }, ...members]);
}

export function judgeWith(isLost: boolean, limits: BatteryLimits): (vehicle: Vehicle) => Status {
  return (vehicle) => statusOf(vehicle, isLost, limits);
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
