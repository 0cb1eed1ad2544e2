import type { Vehicle } from './fleet';

/** Ready green, active blue, warning amber, critical red, lost grey; each has a word and a symbol of its own shape too. */
export type Level = 'ready' | 'active' | 'warning' | 'critical' | 'lost';

export interface Status {
  level: Level;
  word: string;
  symbol: string;
}

const SYMBOLS: Record<Level, string> = { ready: '✓', active: '▶', warning: '▲', critical: '✖', lost: '?' };

export const LOW_BATTERY = 0.3;
export const EMPTY_BATTERY = 0.15;

/** What an operator must know first about a vehicle: the worst that is true of it. */
export function statusOf(vehicle: Vehicle, stationLost: boolean): Status {
  const { level, word } = judge(vehicle, stationLost);
  return { level, word, symbol: SYMBOLS[level] };
}

function judge({ fields }: Vehicle, stationLost: boolean): { level: Level; word: string } {
  if (stationLost) return { level: 'lost', word: 'old data' };
  if (fields.connection === 'conflict') return { level: 'critical', word: 'id conflict' };
  if (fields.connection === 'lost') return { level: 'lost', word: 'link lost' };
  const battery = fields.battery?.remaining;
  if (battery !== undefined && battery < EMPTY_BATTERY) return { level: 'critical', word: 'battery empty' };
  if (fields.health && !fields.health.position_ok) return { level: 'warning', word: 'no position' };
  if (battery !== undefined && battery < LOW_BATTERY) return { level: 'warning', word: 'battery low' };
  if (fields.armed) return { level: 'active', word: fields.landed === false ? 'in the air' : 'armed' };
  if (fields.health && !fields.health.prearm_ok) return { level: 'warning', word: 'not ready to arm' };
  return { level: 'ready', word: fields.armed === undefined ? 'connected' : 'disarmed' };
}
