import type { Alarm, Severity } from './protocol';

/** Alarms of one kind, told as one: 250 vehicles that fall silent together are one thing to see. */
export interface AlarmGroup {
  /** The kind, and whether somebody has acknowledged it. */
  key: string;
  kind: string;
  severity: Severity;
  numbers: number[];
  vehicles: string[];
  /** "copter 1 silent, last known in the air at 20 m", or "250 vehicles silent". */
  title: string;
  /** Some of them by name, where they are several. */
  names: string;
  /** When the first of them began, by this browser's clock in ms; nothing for what has no age that matters. */
  since: number | undefined;
  acknowledgedBy: string;
}

/** An alarm with the time at which it began, by this browser's clock in ms. */
export interface KnownAlarm extends Alarm {
  since: number;
}

const MANY = new Map([
  ['silent', 'vehicles silent'],
  ['lost', 'vehicles lost'],
  ['conflict', 'vehicles share their ids with others'],
  ['battery_low', 'vehicles with a low battery'],
  ['battery_critical', 'vehicles with a nearly empty battery'],
  ['failsafe', 'vehicles in a failsafe'],
  ['fence', 'vehicles beyond their fence'],
  ['foreign_mode', 'vehicles in a mode not asked for here'],
  ['left_armed', 'vehicles left armed'],
]);
/** Of a silence it matters how long it has lasted. */
const AGES = ['silent', 'lost'];
const NAMED = 3;

export function knownAlarms(alarms: Alarm[], now: number): KnownAlarm[] {
  return alarms.map((alarm) => ({ ...alarm, since: now - (alarm.age_s ?? 0) * 1000 }));
}

/** What nobody has acknowledged first, the critical before the rest, and then the latest. */
export function groupAlarms(alarms: KnownAlarm[], nameOf: (vehicle: string) => string): AlarmGroup[] {
  const groups = new Map<string, KnownAlarm[]>();
  for (const alarm of alarms) {
    const key = `${alarm.kind} ${alarm.acknowledged_by ? 'acknowledged' : ''}`;
    groups.set(key, [...(groups.get(key) ?? []), alarm]);
  }
  return [...groups].map(([key, members]) => groupOf(key, members, nameOf)).sort((a, b) => rank(a) - rank(b) || latest(b) - latest(a));
}

function groupOf(key: string, alarms: KnownAlarm[], nameOf: (vehicle: string) => string): AlarmGroup {
  const first = alarms[0]!;
  const vehicles = [...new Set(alarms.map(({ vehicle }) => vehicle))];
  const names = vehicles.slice(0, NAMED).map(nameOf).join(', ');
  const isOne = alarms.length === 1;
  return {
    key,
    kind: first.kind,
    severity: alarms.some(({ severity }) => severity === 'critical') ? 'critical' : 'warning',
    numbers: alarms.map(({ number }) => number),
    vehicles,
    title: isOne ? first.text : `${alarms.length} ${MANY.get(first.kind) ?? `vehicles: ${first.kind}`}`,
    names: isOne ? '' : vehicles.length > NAMED ? `${names} and ${vehicles.length - NAMED} more` : names,
    since: AGES.includes(first.kind) ? Math.min(...alarms.map(({ since }) => since)) : undefined,
    acknowledgedBy: [...new Set(alarms.map(({ acknowledged_by }) => acknowledged_by ?? ''))].join(', '),
  };
}

const rank = ({ acknowledgedBy, severity }: AlarmGroup): number => (acknowledgedBy ? 2 : 0) + (severity === 'critical' ? 0 : 1);
const latest = ({ numbers }: AlarmGroup): number => Math.max(...numbers);

/** What is there now that was not, or was acknowledged, before. */
export function newAlarms(before: Alarm[], now: Alarm[]): Alarm[] {
  const known = new Set(before.map(({ number }) => number));
  return now.filter(({ number, acknowledged_by }) => !known.has(number) && !acknowledged_by);
}

/** What a tab says when the page is not looked at: the worst first. */
export function tabTitle(state: { isLost: boolean; isLatched: boolean; alarms: number }): string {
  const told = state.isLost ? '✖ Station lost' : state.isLatched ? '■ E-STOP' : '';
  const counted = state.alarms > 0 ? `▲ ${state.alarms} alarm${state.alarms === 1 ? '' : 's'}` : '';
  return [told, counted, 'Lapwing'].filter(Boolean).join(' · ');
}
