import type { Level } from '../status';
import { count, flag, list, metres, number, object, share, textUpTo } from '../wire/parsers';

/** Something that a survey drone said, or that became of a command to it. */
export interface SurveyWords {
  /** ISO 8601. */
  at: string;
  text: string;
}

export interface SlotCounts {
  free: number;
  taken: number;
  unknown: number;
}

/** A drone that surveys by itself, as it tells of it over its operator link. */
export interface SurveyDrone {
  name: string;
  connected: boolean;
  /** Why it is not. */
  trouble?: string;
  words: SurveyWords[];
  /** Its operation state; missing before it has said anything. */
  state?: string;
  /** Of its flight controller. */
  mode?: string;
  armed?: boolean;
  healthy?: boolean;
  health_reason?: string;
  user_error?: string;
  height_m?: number;
  battery?: number;
  position?: { lat_deg: number; lon_deg: number };
  slots?: SlotCounts;
  /** 0 to 1: what it has seen of the area that it surveys. */
  coverage?: number;
}

const words = textUpTo(1000);
const drone = object<SurveyDrone>(
  {
    name: words,
    connected: flag,
    trouble: words,
    words: list(object<SurveyWords>({ at: words, text: words }, ['at', 'text'])),
    state: words,
    mode: words,
    armed: flag,
    healthy: flag,
    health_reason: words,
    user_error: words,
    height_m: metres,
    battery: share,
    position: object({ lat_deg: number(-90, 90), lon_deg: number(-180, 180) }, ['lat_deg', 'lon_deg']),
    coverage: share,
    slots: object<SlotCounts>({ free: count, taken: count, unknown: count }, ['free', 'taken', 'unknown']),
  },
  ['name', 'connected', 'words'],
);
const drones = list(drone, ({ name }) => name);

/** Of a message of the feed `survey`; what cannot be read is left out. */
export function surveyOf(content: unknown): SurveyDrone[] {
  return drones((content as { drones?: unknown } | undefined)?.drones) ?? [];
}

const STATES: Record<string, { level: Level; text: string }> = {
  Idle: { level: 'ready', text: 'on the ground' },
  Configure: { level: 'ready', text: 'taking heights' },
  Arm: { level: 'active', text: 'arming' },
  Takeoff: { level: 'active', text: 'taking off' },
  Hover: { level: 'active', text: 'hovering' },
  AutonomousExplore: { level: 'active', text: 'exploring' },
  AutonomousMove: { level: 'active', text: 'moving within the lot' },
  CompulsiveMove: { level: 'active', text: 'moving, whatever the map says' },
  DesiredLocationError: { level: 'warning', text: 'hovering: the place is outside of the lot' },
  NoParkingLotDetected: { level: 'warning', text: 'hovering: no car park in sight' },
  Land: { level: 'active', text: 'coming home' },
  CommunicationLost: { level: 'critical', text: 'coming home: its operator is not heard' },
  Malfunction: { level: 'critical', text: 'coming home: malfunction' },
};
const SYMBOLS: Record<Level, string> = { ready: '✓', active: '●', warning: '▲', critical: '✖', lost: '?' };

/** How it is in a few words. */
export function conditionOf({ connected, trouble, state }: SurveyDrone): { level: Level; symbol: string; text: string } {
  if (!connected) return { level: 'lost', symbol: SYMBOLS.lost, text: `not connected${trouble ? `: ${trouble}` : ''}` };
  if (!state) return { level: 'lost', symbol: SYMBOLS.lost, text: 'connected, has said nothing yet' };
  const { level, text } = STATES[state] ?? { level: 'warning', text: state };
  return { level, symbol: SYMBOLS[level], text };
}

/** How many drones need somebody. */
export function inNeed(all: readonly SurveyDrone[]): number {
  return all.filter((one) => one.healthy === false || ['warning', 'critical', 'lost'].includes(conditionOf(one).level)).length;
}

/** The states in which the drone takes commands that make it fly somewhere. */
const IN_FLIGHT = new Set([
  'Hover',
  'AutonomousExplore',
  'AutonomousMove',
  'CompulsiveMove',
  'DesiredLocationError',
  'NoParkingLotDetected',
]);
export function canFly({ connected, state }: SurveyDrone): boolean {
  return connected && state !== undefined && IN_FLIGHT.has(state);
}
