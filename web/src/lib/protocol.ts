/** The station's messages, protocol 1: docs/reference/station-messages.md. SI units and radians; lat and lon in degrees. */

import type { Position, VehicleFields } from './wire/vehicle_fields';

export const PROTOCOL = 1;

export type * from './wire/vehicle_fields';

export interface VehicleUpdate extends VehicleFields {
  id: string;
  /** Seconds since each key was heard, at the moment the message was made. */
  age_s?: Record<string, number>;
}

export interface Picture extends Position {
  number: number;
  relative_alt_m: number;
}

export type TaskState = 'waiting' | 'running' | 'done' | 'failed' | 'stopped';

export interface Task {
  id: number;
  kind: string;
  label: string;
  line: number;
  state: TaskState;
  vehicle?: string;
  detail?: string;
  children?: Task[];
}

export type ScriptState = 'idle' | 'running' | 'stopping' | 'stopped' | 'done' | 'failed';

export interface Diagnostic {
  severity: 'error' | 'warning' | 'note';
  file: string;
  line: number;
  column: number;
  end_line: number;
  end_column: number;
  code?: string;
  message: string;
  hint?: string;
  notes?: Diagnostic[];
}

export interface Script {
  name: string;
  state: ScriptState;
  message: string;
  source: string;
  diagnostics: Diagnostic[];
}

export type LogLevel = 'debug' | 'info' | 'warn' | 'error';

export interface LogLine {
  seq: number;
  time: string;
  level: LogLevel;
  source: string;
  text: string;
}

export type Action =
  'arm' | 'disarm' | 'take_off' | 'land' | 'rtl' | 'hold' | 'go_to' | 'set_mode' | 'start_mission' | 'pause_mission' | 'resume_mission';

/** What a command needs beside its action and its vehicles. */
export interface CommandDetails {
  height_m?: number;
  lat_deg?: number;
  lon_deg?: number;
  mode?: string;
  /** Rules of plausibility that it may break, with the reasons. */
  allow?: Record<string, string>;
}

export type CommandState =
  'waiting' | 'accepted' | 'under_way' | 'confirmed' | 'refused' | 'timed_out' | 'expired' | 'superseded' | 'cut_short';

export interface Command {
  number: number;
  action: Action;
  by: string;
  asked: string;
  height_m?: number;
  place?: Position;
  mode?: string;
  allow?: Record<string, string>;
  vehicles: CommandOutcome[];
}

/** What one vehicle made of a command. */
export interface CommandOutcome {
  vehicle: string;
  state: CommandState;
  reason?: string;
  /** To go or to climb, while it is under way. */
  left_m?: number;
  /** Of plausibility, that refused it. */
  rule?: string;
}

export type StopAction = 'hold' | 'land' | 'rtl' | 'terminate';

export interface Emergency {
  latched: boolean;
  action: StopAction;
  by: string;
  since?: string;
  vehicles: { vehicle: string; acknowledged: boolean; confirmed: boolean; tries: number; detail: string }[];
}

export type Severity = 'warning' | 'critical';

/** What an operator must be told without having looked. */
export interface Alarm {
  number: number;
  /** "silent", "battery_low" ...: lib/alarms.ts has words for those that it knows. */
  kind: string;
  severity: Severity;
  vehicle: string;
  text: string;
  raised: string;
  /** When the message was made. */
  age_s: number;
  acknowledged_by?: string;
}

export interface Alarms {
  /** Below which share a battery counts as low. */
  battery?: { low: number; critical: number };
  alarms: Alarm[];
}

export interface Hello {
  type: 'hello';
  /** What this viewer is called as a commander of vehicles. */
  operator?: string;
  protocol: number;
  version: string;
  server_time: string;
  site: { name: string; origin?: Position; tiles?: string };
  /** Revisions mean something within one run of the station only. */
  run?: string;
  feeds?: FeedEntry[];
  /** The station has no present: this session of what it keeps is what there is to see. */
  looks_back?: { session: string };
}

export interface FeedEntry {
  name: string;
  /** What binary messages call it. */
  id: number;
}

export interface Reply {
  type: 'reply';
  id: string;
  ok: boolean;
  error?: { message: string; hint: string };
  diagnostics?: Diagnostic[];
}

export type ServerMessage =
  | Hello
  | { type: 'vehicles'; time_s: number; full: boolean; vehicles: VehicleUpdate[] }
  | { type: 'plan'; vehicle: string; path: Position[] }
  | { type: 'pictures'; vehicle: string; full: boolean; pictures: Picture[] }
  | { type: 'tasks'; trees: Task[] }
  | ({ type: 'script' } & Script)
  | { type: 'log'; lines: LogLine[] }
  | ({ type: 'emergency' } & Emergency)
  | { type: 'commands'; commands: Command[] }
  | ({ type: 'alarms' } & Alarms)
  | Reply
  | { type: 'pong'; id: string; server_time: string };

/** What the station answers with a reply. */
export type Request =
  | { type: 'start_script'; name: string; source: string }
  | { type: 'stop_script' }
  | ({ type: 'command'; action: Action; vehicles: string[]; take_over?: boolean } & CommandDetails)
  | { type: 'emergency_stop'; action?: StopAction }
  | { type: 'release_emergency_stop' }
  | { type: 'acknowledge_alarms'; numbers: number[] }
  | { type: 'request_control' | 'yield_control' | 'keep_control'; vehicle: string };

export type ClientMessage =
  | (Request & { id: string })
  | { type: 'ping'; id: string }
  | { type: 'subscribe'; id: string; feeds: string[]; run: string; revisions: Record<string, number> };
