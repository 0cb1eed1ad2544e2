import type { Level } from '../status';
import { flag, list, number, object, seconds, textUpTo, word } from '../wire/parsers';

export interface ModuleError {
  code: number;
  severity: 'notice' | 'degraded' | 'critical';
  meaning: string;
  what_to_do: string;
}

/** A part of a vehicle that says itself how it is. */
export interface Module {
  /** "MMU". */
  module: string;
  name: string;
  /** Without it the vehicle does not move. */
  required: boolean;
  state: 'unheard' | 'starting' | 'ready' | 'failed' | 'silent';
  error?: ModuleError;
  /** Of the process that it runs in. */
  memory_bytes?: number;
  cpu_share?: number;
  rate_hz?: number;
  /** Since it was last heard, when the message was made. */
  age_s?: number;
}

/** The modules of a vehicle, and whether they let it move. */
export interface VehicleHealth {
  id: string;
  name: string;
  may_move: boolean;
  needs_restart: boolean;
  who?: string;
  reason?: string;
  what_to_do?: string;
  modules: Module[];
}

const words = textUpTo(500);
const error = object<ModuleError>(
  {
    code: number(0, 0xffff),
    severity: word(['notice', 'degraded', 'critical'], 'critical'), // what nobody knows may be anything
    meaning: words,
    what_to_do: words,
  },
  ['code', 'severity', 'meaning', 'what_to_do'],
);
const module = object<Module>(
  {
    module: words,
    name: words,
    required: flag,
    state: word(['unheard', 'starting', 'ready', 'failed', 'silent'], 'unheard'),
    error,
    memory_bytes: number(0, 1e15),
    cpu_share: number(0, 1e4),
    rate_hz: number(0, 1e6),
    age_s: seconds,
  },
  ['module', 'name', 'required', 'state'],
);
const vehicle = object<VehicleHealth>(
  {
    id: words,
    name: words,
    may_move: flag,
    needs_restart: flag,
    who: words,
    reason: words,
    what_to_do: words,
    modules: list(module, (one) => one.module),
  },
  ['id', 'name', 'may_move', 'needs_restart', 'modules'],
);
const vehicles = list(vehicle, (one) => one.id);

/** Of a message of the feed `health`; what cannot be read is left out. */
export function healthOf(content: unknown): VehicleHealth[] {
  return vehicles((content as { vehicles?: unknown } | undefined)?.vehicles) ?? [];
}

export interface Condition {
  level: Level;
  word: string;
  symbol: string;
}

const SYMBOLS: Record<Level, string> = { ready: '✓', active: '●', warning: '▲', critical: '✖', lost: '?' };
/** Who needs somebody first. */
const ORDER: readonly Level[] = ['critical', 'warning', 'lost', 'active', 'ready'];
const rank = (level: Level): number => ORDER.indexOf(level);

export function conditionOf(module: Module): Condition {
  const { level, word } = judge(module);
  return { level, word, symbol: SYMBOLS[level] };
}

function judge({ state, required, error }: Module): { level: Level; word: string } {
  if (state === 'failed') return { level: 'critical', word: 'failed' };
  if (state === 'silent') return { level: required ? 'critical' : 'lost', word: 'silent' };
  if (error?.severity === 'critical') return { level: 'critical', word: 'critical' };
  if (state === 'unheard') return { level: required ? 'warning' : 'lost', word: 'not started' };
  if (error?.severity === 'degraded') return { level: 'warning', word: 'degraded' };
  if (state === 'starting') return { level: 'active', word: 'starting' };
  return error ? { level: 'active', word: 'notice' } : { level: 'ready', word: 'well' };
}

/** In the order in which they need somebody; those that need nobody stay as they were. */
export function byNeed(health: readonly VehicleHealth[]): VehicleHealth[] {
  const sorted = health.map((one) => ({
    ...one,
    modules: [...one.modules].sort((a, b) => rank(conditionOf(a).level) - rank(conditionOf(b).level)),
  }));
  const need = ({ may_move, modules }: VehicleHealth): number =>
    (may_move ? ORDER.length : 0) + (modules[0] ? rank(conditionOf(modules[0]).level) : ORDER.length);
  return sorted.sort((a, b) => need(a) - need(b));
}

/** How many vehicles stand because of what their modules say, or have a module that does less than it should. */
export function inNeed(health: readonly VehicleHealth[]): number {
  const isInNeed = (one: Module): boolean => ['critical', 'warning'].includes(conditionOf(one).level);
  return health.filter(({ may_move, modules }) => !may_move || modules.some(isInNeed)).length;
}

/** "212 MB". */
export function memoryText(bytes: number | undefined): string {
  return bytes === undefined ? '–' : `${(bytes / 1e6).toFixed(bytes < 9.95e6 ? 1 : 0)} MB`;
}
