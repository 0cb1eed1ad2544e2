import type { Vehicle } from './fleet';
import { metres } from './format';
import type { Action, Command, CommandOutcome, CommandState, Emergency, Position } from './protocol';
import type { Level } from './status';

export const ACTION_WORDS: Record<Action, string> = {
  arm: 'Arm',
  disarm: 'Disarm',
  take_off: 'Take off',
  land: 'Land',
  rtl: 'Return',
  hold: 'Hold',
  go_to: 'Go to',
  set_mode: 'Set mode',
  start_mission: 'Start mission',
  pause_mission: 'Pause mission',
  resume_mission: 'Resume mission',
};

/** Bring a vehicle to rest or home: need no confirmation, and pass whoever commands it. */
const STOPS: readonly Action[] = ['hold', 'land', 'rtl', 'disarm', 'pause_mission'];
export const isStop = (action: Action): boolean => STOPS.includes(action);

const STATES: Record<CommandState, { word: string; symbol: string; level: Level }> = {
  waiting: { word: 'sent', symbol: '…', level: 'active' },
  accepted: { word: 'acknowledged', symbol: '✓', level: 'active' },
  under_way: { word: 'under way', symbol: '➤', level: 'active' },
  confirmed: { word: 'confirmed', symbol: '✔', level: 'ready' },
  refused: { word: 'refused', symbol: '✖', level: 'critical' },
  timed_out: { word: 'no effect seen', symbol: '✖', level: 'critical' },
  expired: { word: 'expired', symbol: '⌛', level: 'warning' },
  superseded: { word: 'superseded', symbol: '↷', level: 'lost' },
  cut_short: { word: 'cut short', symbol: '✂', level: 'warning' },
};
/** What is done when it is done, where that takes time. */
const GOALS: Partial<Record<Action, string>> = { take_off: 'reached', go_to: 'reached', land: 'landed', rtl: 'returned' };
const doneWord = (action: Action): string => GOALS[action] ?? STATES.confirmed.word;

/** A state that this app does not know is told by its own word. */
export function stateOf(state: CommandState, action: Action): { word: string; symbol: string; level: Level } {
  if (!Object.hasOwn(STATES, state)) return { word: state, symbol: '?', level: 'lost' };
  return state === 'confirmed' ? { ...STATES.confirmed, word: doneWord(action) } : STATES[state];
}

const OPEN: readonly CommandState[] = ['waiting', 'accepted', 'under_way'];

/** "Take off, 15 m", "Set mode GUIDED". */
export function titleOf({ action, height_m, mode }: Command): string {
  const word = ACTION_WORDS[action];
  if (mode) return `${word} ${mode}`;
  return height_m === undefined ? word : `${word}, ${height_m.toFixed(0)} m`;
}

/** "3 of 4 confirmed", and what else there is to know. */
export function summaryOf({ action, vehicles }: Command): string {
  const count = (...states: CommandState[]): number => vehicles.filter(({ state }) => states.includes(state)).length;
  const failed = count('refused', 'timed_out', 'expired');
  const cut = count('cut_short');
  const open = count(...OPEN);
  return [
    `${count('confirmed')} of ${vehicles.length} ${doneWord(action)}`,
    failed > 0 && `${failed} failed`,
    cut > 0 && `${cut} cut short`,
    open > 0 && `${open} under way`,
  ]
    .filter(Boolean)
    .join(', ');
}

/** The latest command that concerns some of the vehicles, with what these made of it. */
export function latestFor(commands: readonly Command[], ids: readonly string[]): Command | undefined {
  for (const command of [...commands].reverse()) {
    const vehicles = command.vehicles.filter(({ vehicle }) => ids.includes(vehicle));
    if (vehicles.length > 0) return { ...command, vehicles };
  }
  return undefined;
}

/** In one line what has become of a command: of one vehicle how far it is, of several the sum. */
export function headlineOf(command: Command): { text: string; symbol: string; level: Level } {
  const [only] = command.vehicles;
  if (only && command.vehicles.length === 1) {
    const { word, symbol, level } = stateOf(only.state, command.action);
    return { text: [titleOf(command) + ': ' + word, only.reason].filter(Boolean).join(', '), symbol, level };
  }
  const states = command.vehicles.map(({ state }) => state);
  const worst = (['refused', 'timed_out', 'expired', 'cut_short', 'waiting', 'accepted', 'under_way'] as const).find((state) =>
    states.includes(state),
  );
  const { symbol, level } = stateOf(worst ?? 'confirmed', command.action);
  return { text: `${titleOf(command)}: ${summaryOf(command)}`, symbol, level };
}

/** Where a vehicle is being sent, until it is there or that was cut short. */
export interface Destination {
  vehicle: string;
  place: Position;
  left: string;
}

export function destinationsOf(commands: readonly Command[]): Destination[] {
  const destinations = new Map<string, Destination>();
  for (const { action, place, vehicles } of commands) {
    if (action !== 'go_to' || !place) continue;
    for (const outcome of vehicles) {
      if (OPEN.includes(outcome.state)) destinations.set(outcome.vehicle, { vehicle: outcome.vehicle, place, left: leftOf(outcome) });
    }
  }
  return [...destinations.values()];
}

function leftOf({ left_m, state }: CommandOutcome): string {
  if (left_m === undefined) return state === 'under_way' ? '' : stateOf(state, 'go_to').word;
  return left_m < 999.5 ? metres(left_m) : `${(left_m / 1000).toFixed(1)} km`;
}

export function stopSummary({ vehicles }: Emergency): string {
  const confirmed = vehicles.filter((vehicle) => vehicle.confirmed).length;
  const acknowledged = vehicles.filter((vehicle) => vehicle.acknowledged).length;
  return `${confirmed} of ${vehicles.length} stopped, ${acknowledged} acknowledged`;
}

/** Those of the vehicles that somebody else commands, by whom: commands to them take them over. */
export function commandedByOthers(vehicles: Vehicle[], me: string): { id: string; name: string; by: string }[] {
  return vehicles.flatMap(({ id, fields }) => {
    const by = fields.control?.commander ?? '';
    return by && by !== me ? [{ id, name: fields.name || id, by }] : [];
  });
}

/** Requests for vehicles that this operator commands. */
export function requestsTo(vehicles: Iterable<Vehicle>, me: string): { id: string; name: string; by: string; granted_at_s: number }[] {
  return [...vehicles].flatMap(({ id, fields }) => {
    const control = fields.control;
    if (!control?.asked_for_by || control.commander !== me) return [];
    return [{ id, name: fields.name || id, by: control.asked_for_by, granted_at_s: control.granted_at_s ?? 0 }];
  });
}

/** Who asks for a vehicle that somebody commands, if anybody does. */
export function requestOf(vehicle: Vehicle | undefined, me: string): { by: string; isMine: boolean; granted_at_s: number } | undefined {
  const { asked_for_by: by, granted_at_s = 0 } = vehicle?.fields.control ?? {};
  return by ? { by, isMine: by === me, granted_at_s } : undefined;
}

const ARDUPILOT: Record<string, string[]> = {
  copter: ['STABILIZE', 'ALT_HOLD', 'LOITER', 'POSHOLD', 'GUIDED', 'AUTO', 'BRAKE', 'RTL', 'SMART_RTL', 'LAND', 'CIRCLE'],
  plane: ['MANUAL', 'STABILIZE', 'FBWA', 'FBWB', 'CRUISE', 'LOITER', 'CIRCLE', 'GUIDED', 'AUTO', 'RTL', 'TAKEOFF', 'AUTOLAND'],
  vtol: ['FBWA', 'CRUISE', 'LOITER', 'GUIDED', 'AUTO', 'RTL', 'QHOVER', 'QLOITER', 'QLAND', 'QRTL'],
  rover: ['MANUAL', 'STEERING', 'HOLD', 'LOITER', 'GUIDED', 'AUTO', 'RTL', 'SMART_RTL'],
  boat: ['MANUAL', 'HOLD', 'LOITER', 'GUIDED', 'AUTO', 'RTL', 'SMART_RTL'],
  sub: ['MANUAL', 'STABILIZE', 'ALT_HOLD', 'POSHOLD', 'GUIDED', 'AUTO', 'SURFACE'],
};
const PX4 = ['MANUAL', 'ALTCTL', 'POSCTL', 'STABILIZED', 'AUTO.LOITER', 'AUTO.MISSION', 'AUTO.RTL', 'AUTO.LAND'];

/** The modes that all of the vehicles have, as far as this app knows them. */
export function commonModes(vehicles: Vehicle[]): string[] {
  const lists = vehicles.map(({ fields }) => (fields.autopilot === 'px4' ? PX4 : (ARDUPILOT[fields.family ?? ''] ?? [])));
  return (lists[0] ?? []).filter((mode) => lists.every((list) => list.includes(mode)));
}
