import type {
  Alarm,
  Alarms,
  Battery,
  Command,
  Component,
  Diagnostic,
  Emergency,
  FeedEntry,
  Hello,
  LinkQuality,
  LogLine,
  Picture,
  Position,
  Reply,
  Script,
  ServerMessage,
  Task,
  VehicleFields,
  VehicleUpdate,
} from './protocol';

/**
 * The border to the station: what comes in through here has the types that protocol.ts promises, finite numbers within what is
 * possible, texts and lists of a bearable size, and no two entries of one id. What does not is left out, as if it had not been
 * heard: one vehicle with an impossible position takes nothing from the others. Keys that this app does not know come through
 * as far as they are plain data.
 */

type Parse<T> = (value: unknown) => T | undefined;
type Shape<T> = { [K in keyof T]-?: Parse<Exclude<T[K], undefined>> };

const LONGEST_TEXT = 20_000;
const LONGEST_SOURCE = 4_000_000;
const LONGEST_LIST = 20_000;
/** Of tasks within tasks, and of data that is not known here. */
const DEEPEST = 60;

const flag: Parse<boolean> = (value) => (typeof value === 'boolean' ? value : undefined);
const textUpTo =
  (limit: number): Parse<string> =>
  (value) =>
    typeof value === 'string' ? value.slice(0, limit) : undefined;
const text = textUpTo(LONGEST_TEXT);
const number =
  (low: number, high: number): Parse<number> =>
  (value) =>
    typeof value === 'number' && value >= low && value <= high ? value : undefined;
const count = number(0, Number.MAX_SAFE_INTEGER);
const share = number(0, 1);
const seconds = number(0, 1e9);
const angle = number(-1000, 1000);
const metres = number(-1e7, 1e7);
const speed = number(-1000, 1000);
const ratio = number(-1e6, 1e6);

/** One of the words; for others `otherwise`, where one is given. */
function word<T extends string>(words: readonly T[], otherwise?: T): Parse<T> {
  return (value) => (words.includes(value as T) ? (value as T) : otherwise);
}

/** Those entries that can be read; of several with one key the first. */
function list<T>(item: Parse<T>, keyOf?: (entry: T) => string | number): Parse<T[]> {
  return (value) => {
    if (!Array.isArray(value)) return undefined;
    const entries: T[] = [];
    const seen = new Set<string | number>();
    for (const one of value.slice(0, LONGEST_LIST)) {
      const entry = item(one);
      if (entry === undefined || (keyOf && seen.has(keyOf(entry)))) continue;
      if (keyOf) seen.add(keyOf(entry));
      entries.push(entry);
    }
    return entries;
  };
}

const isObject = (value: unknown): value is Record<string, unknown> => typeof value === 'object' && value !== null && !Array.isArray(value);

/** Data without any promise but that it is finite, not too deep and of a bearable size. */
function plain(value: unknown, depth = 0): unknown {
  if (typeof value === 'string') return text(value);
  if (typeof value === 'number') return Number.isFinite(value) ? value : undefined;
  if (typeof value === 'boolean') return value;
  if (depth >= DEEPEST) return undefined;
  if (Array.isArray(value))
    return value
      .slice(0, LONGEST_LIST)
      .map((one) => plain(one, depth + 1))
      .filter((one) => one !== undefined);
  if (!isObject(value)) return undefined;
  const entries = Object.entries(value).map(([key, one]): [string, unknown] => [key, plain(one, depth + 1)]);
  return Object.fromEntries(entries.filter(([key, one]) => key !== '__proto__' && one !== undefined));
}

/** Texts by their keys. */
const texts: Parse<Record<string, string>> = (value) => {
  const entries = Object.entries(isObject(value) ? value : {}).map(([key, one]) => [key, text(one)] as const);
  return Object.fromEntries(entries.filter(([key, one]) => key !== '__proto__' && one !== undefined)) as Record<string, string>;
};

/** An object of that shape; without one of the `needed` keys it is none. Other keys that cannot be read are left out. */
function object<T extends object>(shape: Shape<T>, needed: readonly (keyof T)[]): Parse<T> {
  return (value) => {
    if (!isObject(value)) return undefined;
    const result: Record<string, unknown> = {};
    for (const [key, one] of Object.entries(value)) {
      if (key === '__proto__') continue;
      const parse = Object.hasOwn(shape, key) ? (shape as Record<string, Parse<unknown>>)[key]! : plain;
      const parsed = parse(one);
      if (parsed !== undefined) result[key] = parsed;
    }
    return needed.every((key) => Object.hasOwn(result, key)) ? (result as T) : undefined;
  };
}

const POSITION: Shape<Position> = { lat_deg: number(-90, 90), lon_deg: number(-180, 180), alt_m: metres };
const position = object(POSITION, ['lat_deg', 'lon_deg']);
const positions = list(position);

const BATTERY: Shape<Battery> = {
  id: count,
  remaining: share,
  voltage_v: number(0, 10_000),
  current_a: number(-10_000, 10_000),
  consumed_ah: number(0, 1e6),
  time_left_s: seconds,
  time_left_error_s: seconds,
  time_left_is_estimate: flag,
  in_flight_s: seconds,
  in_flight_error_s: seconds,
};
const battery = object(BATTERY, ['remaining']);

const link = object<LinkQuality>(
  { name: text, loss: share, messages_per_s: number(0, 1e6), bytes_per_s: number(0, 1e9), round_trip_s: seconds, alive: flag, used: flag },
  ['name', 'messages_per_s', 'alive', 'used'],
);
const component = object<Component>({ id: count, kind: text, state: text, model: text }, ['id', 'kind']);
const said = object({ severity: number(0, 7), text, component: count }, ['severity', 'text']);

const FIELDS: Shape<VehicleFields> = {
  system_id: count,
  name: text,
  family: word(['copter', 'plane', 'vtol', 'rover', 'boat', 'sub', 'unknown'], 'unknown'),
  autopilot: text,
  connection: word(['ok', 'lost', 'conflict']),
  link: text,
  links: list(link, ({ name }) => name),
  payload: list(text, (name) => name),
  track_m: number(0, 1e9),
  heartbeat: (value) => (value === true ? true : undefined),
  silent: flag,
  mode: text,
  armed: flag,
  landed: flag,
  position,
  relative_alt_m: metres,
  velocity_m_s: object({ north: speed, east: speed, down: speed }, ['north', 'east', 'down']),
  attitude_rad: object({ roll: angle, pitch: angle, yaw: angle }, ['roll', 'pitch', 'yaw']),
  heading_rad: angle,
  battery,
  further_batteries: list(battery),
  gps: object({ fix: text, satellites: number(0, 1000), hdop: number(0, 1e6) }, ['fix']),
  estimator: object({ velocity: ratio, position_horizontal: ratio, position_vertical: ratio, compass: ratio }, [
    'velocity',
    'position_horizontal',
    'position_vertical',
  ]),
  unhealthy: list(text, (name) => name),
  arming_reasons: list(text, (reason) => reason),
  remote_control: object({ lost: flag, channels: count, rssi: share, pulses_us: list(number(0, 65_535)) }, ['lost', 'channels']),
  radio: object({ rssi: ratio, remote_rssi: ratio, noise: ratio, remote_noise: ratio, buffer_free: share, receive_errors: count }, [
    'noise',
    'remote_noise',
    'buffer_free',
  ]),
  hud: object({ airspeed_m_s: speed, climb_m_s: speed, throttle: number(-1, 2) }, ['airspeed_m_s', 'climb_m_s', 'throttle']),
  wind: object({ from_rad: angle, speed_m_s: number(0, 1000) }, ['from_rad', 'speed_m_s']),
  fence: object({ breached: flag, breaches: count, type: text }, ['breached']),
  health: object({ position_ok: flag, prearm_ok: flag }, ['position_ok', 'prearm_ok']),
  home: position,
  mission: object({ current: count, total: count, complete: flag, state: text }, ['current', 'total', 'complete']),
  waypoint_distance_m: number(0, 1e8),
  gimbal: object({ roll_rad: angle, pitch_rad: angle, yaw_rad: angle, yaw_is_from_north: flag }, [
    'pitch_rad',
    'yaw_rad',
    'yaw_is_from_north',
  ]),
  components: list(component, ({ id }) => id),
  pictures: object({ taken: count, lost: count }, ['taken', 'lost']),
  texts: list(said),
  control: object({ commander: text, asked_for_by: text, granted_at_s: seconds }, ['commander']),
  foreign_change: text,
};

const ages: Parse<Record<string, number>> = (value) => {
  if (!isObject(value)) return undefined;
  const known: [string, number][] = [];
  for (const [key, age] of Object.entries(value)) {
    const parsed = number(-1e9, 1e9)(age); // the station's clock may be a little behind what it has just heard
    if (parsed !== undefined && key !== '__proto__') known.push([key, Math.max(0, parsed)]);
  }
  return Object.fromEntries(known);
};

const updateShape: Shape<VehicleUpdate> = { ...FIELDS, id: text, age_s: ages };
const anyUpdate = object<VehicleUpdate>(updateShape, ['id']);

/** What could not be read was not heard, so it has no new age. */
const vehicleUpdate: Parse<VehicleUpdate> = (value) => {
  const update = anyUpdate(value);
  if (!update || update.id === '' || !update.age_s) return update?.id ? update : undefined;
  for (const key of Object.keys(update.age_s)) {
    const wasRefused = Object.hasOwn(value as object, key) && !Object.hasOwn(update, key);
    if (wasRefused) delete update.age_s[key];
  }
  return update;
};

const picture = object<Picture>({ ...POSITION, number: count, relative_alt_m: metres }, ['lat_deg', 'lon_deg', 'number']);

function task(value: unknown, depth = 0): Task | undefined {
  const parse = object<Task>(
    {
      id: number(-1e15, 1e15),
      kind: text,
      label: text,
      line: count,
      state: word(['waiting', 'running', 'done', 'failed', 'stopped'], 'waiting'),
      vehicle: text,
      detail: text,
      children:
        depth < DEEPEST
          ? list(
              (child) => task(child, depth + 1),
              ({ id }) => id,
            )
          : () => undefined,
    },
    ['id', 'kind', 'state'],
  );
  const found = parse(value);
  return found && { ...found, label: found.label ?? '', line: found.line ?? 0 };
}

function diagnostic(value: unknown, depth = 0): Diagnostic | undefined {
  const line = number(0, 1e7);
  return object<Diagnostic>(
    {
      severity: word(['error', 'warning', 'note'], 'error'),
      file: text,
      line,
      column: line,
      end_line: line,
      end_column: line,
      code: text,
      message: text,
      hint: text,
      notes: depth < 3 ? list((note) => diagnostic(note, depth + 1)) : () => undefined,
    },
    ['severity', 'line', 'column', 'end_line', 'end_column', 'message'],
  )(value);
}
const diagnostics = list((one) => diagnostic(one));

const logLine = object<LogLine>({ seq: count, time: text, level: word(['debug', 'info', 'warn', 'error'], 'info'), source: text, text }, [
  'seq',
  'time',
  'level',
  'source',
  'text',
]);

const outcome = object<Command['vehicles'][number]>({ vehicle: text, state: text as Parse<never>, reason: text, left_m: metres }, [
  'vehicle',
  'state',
]);
const command = object<Command>(
  {
    number: count,
    action: text as Parse<never>,
    by: text,
    asked: text,
    height_m: metres,
    place: position,
    mode: text,
    allow: texts,
    vehicles: list(outcome, ({ vehicle }) => vehicle),
  },
  ['number', 'action', 'by', 'asked', 'vehicles'],
);

const EMERGENCY: Shape<Emergency> = {
  latched: flag,
  action: word(['hold', 'land', 'rtl', 'terminate'], 'hold'),
  by: text,
  since: text,
  vehicles: list(
    object<Emergency['vehicles'][number]>({ vehicle: text, acknowledged: flag, confirmed: flag, tries: count, detail: text }, [
      'vehicle',
      'acknowledged',
      'confirmed',
      'tries',
      'detail',
    ]),
    ({ vehicle }) => vehicle,
  ),
};

const alarm = object<Alarm>(
  {
    number: count,
    kind: text,
    severity: word(['warning', 'critical'], 'critical'),
    vehicle: text,
    text,
    raised: text,
    age_s: seconds,
    acknowledged_by: text,
  },
  ['number', 'kind', 'severity', 'vehicle', 'text'],
);
const ALARMS: Shape<Alarms> = {
  battery: object({ low: share, critical: share }, ['low', 'critical']),
  alarms: list(alarm, ({ number: id }) => id),
};

const HELLO: Shape<Hello> = {
  type: word(['hello']),
  operator: text,
  protocol: count,
  version: text,
  server_time: text,
  site: object({ name: text, origin: position, tiles: text }, []),
  run: text,
  feeds: list(object<FeedEntry>({ name: text, id: count }, ['name', 'id']), ({ id }) => id),
};
const SCRIPT: Shape<Script> = {
  name: text,
  state: word(['idle', 'running', 'stopping', 'stopped', 'done', 'failed'], 'idle'),
  message: text,
  source: textUpTo(LONGEST_SOURCE),
  diagnostics,
};
const REPLY: Shape<Reply> = {
  type: word(['reply']),
  id: text,
  ok: flag,
  error: object({ message: text, hint: text }, []),
  diagnostics,
};

/** The names of the station's scripts, as `GET /api/v1/scripts` has them. */
export function parseScripts(body: unknown): string[] {
  const named = object<{ name: string }>({ name: text }, ['name']);
  const found = object<{ scripts: { name: string }[] }>({ scripts: list(named, ({ name }) => name) }, ['scripts'])(body);
  return (found?.scripts ?? []).map(({ name }) => name);
}

type Typed<T extends ServerMessage['type']> = Extract<ServerMessage, { type: T }>;
/** By `type`; an object without a prototype, so that no word of the station finds anything else. */
const MESSAGES: { [T in ServerMessage['type']]: Parse<Typed<T>> } = Object.assign(Object.create(null) as object, {
  hello: object<Typed<'hello'>>(HELLO, []),
  vehicles: object<Typed<'vehicles'>>(
    { type: word(['vehicles']), time_s: seconds, full: flag, vehicles: list(vehicleUpdate, ({ id }) => id) },
    ['time_s', 'full', 'vehicles'],
  ),
  plan: object<Typed<'plan'>>({ type: word(['plan']), vehicle: text, path: positions }, ['vehicle', 'path']),
  pictures: object<Typed<'pictures'>>({ type: word(['pictures']), vehicle: text, full: flag, pictures: list(picture) }, [
    'vehicle',
    'full',
    'pictures',
  ]),
  tasks: object<Typed<'tasks'>>({ type: word(['tasks']), trees: list((tree) => task(tree)) }, ['trees']),
  script: object<Typed<'script'>>({ type: word(['script']), ...SCRIPT }, ['name', 'state', 'message', 'source', 'diagnostics']),
  log: object<Typed<'log'>>({ type: word(['log']), lines: list(logLine, ({ seq }) => seq) }, ['lines']),
  emergency: object<Typed<'emergency'>>({ type: word(['emergency']), ...EMERGENCY }, ['latched', 'action', 'by', 'vehicles']),
  commands: object<Typed<'commands'>>({ type: word(['commands']), commands: list(command, ({ number: id }) => id) }, ['commands']),
  alarms: object<Typed<'alarms'>>({ type: word(['alarms']), ...ALARMS }, ['alarms']),
  reply: object<Typed<'reply'>>(REPLY, ['id', 'ok']),
  pong: object<Typed<'pong'>>({ type: word(['pong']), id: text, server_time: text }, []),
});

/** The object in a text; nothing for what is none. */
export function parseObject(data: string): Record<string, unknown> | undefined {
  try {
    const value: unknown = JSON.parse(data);
    return isObject(value) ? value : undefined;
  } catch {
    return undefined;
  }
}

/** The message that an object is; nothing for what is none, or for one of a type that this app does not know. */
export function messageOf(value: Record<string, unknown>): ServerMessage | undefined {
  try {
    if (typeof value.type !== 'string') return undefined;
    const parse = MESSAGES[value.type as ServerMessage['type']] as Parse<ServerMessage> | undefined;
    const message = parse?.(value);
    if (message?.type !== 'hello') return message;
    const { protocol = 0, version = '', site } = message as Partial<Hello>;
    return { ...message, protocol, version, site: { ...site, name: site?.name ?? '' } };
  } catch {
    return undefined;
  }
}

export function parseMessage(data: string): ServerMessage | undefined {
  const value = parseObject(data);
  return value && messageOf(value);
}
