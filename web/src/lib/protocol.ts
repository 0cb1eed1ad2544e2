/** The station's messages, protocol 1: docs/reference/station-messages.md. SI units and radians; lat and lon in degrees. */

export const PROTOCOL = 1;

export interface Position {
  lat_deg: number;
  lon_deg: number;
  alt_m: number;
}

export type Family = 'copter' | 'plane' | 'vtol' | 'rover' | 'boat' | 'sub' | 'unknown';
export type Link = 'ok' | 'lost' | 'conflict';

/** One of the links on which a vehicle is heard, over the last 10 s. */
export interface LinkQuality {
  name: string;
  /** Missing while nothing is heard on it. */
  loss?: number;
  messages_per_s: number;
  bytes_per_s: number;
  round_trip_s?: number;
  alive: boolean;
  used: boolean;
}

export interface Battery {
  /** Not for the first one. */
  id?: number;
  remaining: number;
  voltage_v?: number;
  current_a?: number;
  consumed_ah?: number;
  /** At what the vehicle does now. */
  time_left_s?: number;
  time_left_is_estimate?: boolean;
  /** Of an estimate, to either side. */
  time_left_error_s?: number;
  /** What is left would last so long in flight, by this flight or the last one. */
  in_flight_s?: number;
  in_flight_error_s?: number;
}

/** What else is aboard; its age is that of the key component_ID. */
export interface Component {
  id: number;
  kind: string;
  state?: string;
  model?: string;
}

/** What may be known about a vehicle; a key that is missing was never heard. */
export interface VehicleFields {
  system_id?: number;
  name?: string;
  family?: Family;
  autopilot?: string;
  connection?: Link;
  link?: string;
  links?: LinkQuality[];
  payload?: string[];
  track_m?: number;
  heartbeat?: true;
  /** Nothing has come from it for some seconds; the age of this key is that of the silence. */
  silent?: boolean;
  mode?: string;
  armed?: boolean;
  landed?: boolean;
  position?: Position;
  relative_alt_m?: number;
  velocity_m_s?: { north: number; east: number; down: number };
  attitude_rad?: { roll: number; pitch: number; yaw: number };
  heading_rad?: number;
  battery?: Battery;
  further_batteries?: Battery[];
  gps?: { fix: string; satellites?: number; hdop?: number };
  estimator?: { velocity?: number; position_horizontal?: number; position_vertical?: number; compass?: number };
  unhealthy?: string[];
  arming_reasons?: string[];
  remote_control?: { lost: boolean; channels: number; rssi?: number; pulses_us: (number | null)[] };
  radio?: { rssi?: number; remote_rssi?: number; noise?: number; remote_noise?: number; buffer_free?: number; receive_errors: number };
  hud?: { airspeed_m_s?: number; climb_m_s?: number; throttle?: number };
  wind?: { from_rad: number; speed_m_s: number };
  fence?: { breached: boolean; breaches: number; type?: string };
  health?: { position_ok: boolean; prearm_ok: boolean };
  home?: Position;
  mission?: { current: number; total: number; complete: boolean; state?: string };
  waypoint_distance_m?: number;
  gimbal?: { roll_rad: number; pitch_rad: number; yaw_rad: number; yaw_is_from_north: boolean };
  components?: Component[];
  pictures?: { taken: number; lost: number };
  texts?: { severity: number; text: string; component?: number }[];
  control?: { commander: string; asked_for_by?: string; granted_at_s?: number };
  foreign_change?: string;
}

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
