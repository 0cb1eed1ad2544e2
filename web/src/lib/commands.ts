import type { Vehicle } from './fleet';
import type { Action, Command, CommandState, Emergency } from './protocol';
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
  waiting: { word: 'waiting', symbol: '…', level: 'active' },
  accepted: { word: 'accepted', symbol: '✓', level: 'active' },
  confirmed: { word: 'confirmed', symbol: '✔', level: 'ready' },
  refused: { word: 'refused', symbol: '✖', level: 'critical' },
  timed_out: { word: 'no effect seen', symbol: '✖', level: 'critical' },
  expired: { word: 'expired', symbol: '⌛', level: 'warning' },
  superseded: { word: 'superseded', symbol: '↷', level: 'lost' },
};
/** A state that this app does not know is told by its own word. */
export const stateOf = (state: CommandState): { word: string; symbol: string; level: Level } =>
  Object.hasOwn(STATES, state) ? STATES[state] : { word: state, symbol: '?', level: 'lost' };

/** "Take off, 15 m", "Set mode GUIDED". */
export function titleOf({ action, height_m, mode }: Command): string {
  const word = ACTION_WORDS[action];
  if (mode) return `${word} ${mode}`;
  return height_m === undefined ? word : `${word}, ${height_m.toFixed(0)} m`;
}

/** "3 of 4 confirmed", and what else there is to know. */
export function summaryOf({ vehicles }: Command): string {
  const count = (...states: CommandState[]): number => vehicles.filter(({ state }) => states.includes(state)).length;
  const failed = count('refused', 'timed_out', 'expired');
  const open = count('waiting', 'accepted');
  return [`${count('confirmed')} of ${vehicles.length} confirmed`, failed > 0 && `${failed} failed`, open > 0 && `${open} under way`]
    .filter(Boolean)
    .join(', ');
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
