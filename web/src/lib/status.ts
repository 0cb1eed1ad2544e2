import type { Vehicle } from './fleet';

/** Ready green, active blue, warning amber, critical red, lost grey; each has a word and a symbol of its own shape too. */
export type Level = 'ready' | 'active' | 'warning' | 'critical' | 'lost';

export interface Status {
  level: Level;
  word: string;
  symbol: string;
}

const SYMBOLS: Record<Level, string> = { ready: '✓', active: '▶', warning: '▲', critical: '✖', lost: '?' };

/** Below which share a battery counts as low; the station's word goes before this. */
export interface BatteryLimits {
  low: number;
  critical: number;
}
export const USUAL_LIMITS: BatteryLimits = { low: 0.3, critical: 0.15 };

export function batteryLevel(remaining: number, limits: BatteryLimits = USUAL_LIMITS): 'ready' | 'warning' | 'critical' {
  return remaining < limits.critical ? 'critical' : remaining < limits.low ? 'warning' : 'ready';
}

/** What an operator must know first about a vehicle: the worst that is true of it. */
export function statusOf(vehicle: Vehicle, stationLost: boolean, limits: BatteryLimits = USUAL_LIMITS): Status {
  const { level, word } = judge(vehicle, stationLost, limits);
  return { level, word, symbol: SYMBOLS[level] };
}

/** What is shown of it is the last that is known. */
export function isOld({ fields }: Vehicle): boolean {
  return fields.silent === true || fields.connection === 'lost';
}

function judge(vehicle: Vehicle, stationLost: boolean, limits: BatteryLimits): { level: Level; word: string } {
  const { fields } = vehicle;
  if (stationLost) return { level: 'lost', word: 'old data' };
  if (fields.connection === 'conflict') return { level: 'critical', word: 'id conflict' };
  if (fields.connection === 'lost') return { level: 'lost', word: 'link lost' };
  if (isOld(vehicle)) return { level: 'lost', word: 'silent' };
  const battery = fields.battery && batteryLevel(fields.battery.remaining, limits);
  if (battery === 'critical') return { level: 'critical', word: 'battery empty' };
  if (fields.health && !fields.health.position_ok) return { level: 'warning', word: 'no position' };
  if (battery === 'warning') return { level: 'warning', word: 'battery low' };
  if (fields.armed) return { level: 'active', word: fields.landed === false ? 'in the air' : 'armed' };
  if (fields.health && !fields.health.prearm_ok) return { level: 'warning', word: 'not ready to arm' };
  return { level: 'ready', word: fields.armed === undefined ? 'connected' : 'disarmed' };
}
