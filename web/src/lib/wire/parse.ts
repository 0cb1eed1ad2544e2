import {
  count,
  DEEPEST,
  flag,
  isObject,
  list,
  metres,
  number,
  object,
  seconds,
  share,
  text,
  textUpTo,
  word,
  type Parse,
  type Shape,
} from './parsers';
import type {
  Alarm,
  Alarms,
  Command,
  Diagnostic,
  Emergency,
  FeedEntry,
  Hello,
  LogLine,
  Picture,
  Position,
  Reply,
  Script,
  ServerMessage,
  Task,
  VehicleUpdate,
} from '../protocol';
import { VEHICLE } from './vehicle_parsers';

/**
 * The border to the station: what comes in through here has the types that protocol.ts promises, finite numbers within what is
 * possible, texts and lists of a bearable size, and no two entries of one id. What does not is left out, as if it had not been
 * heard: one vehicle with an impossible position takes nothing from the others. Keys that this app does not know come through
 * as far as they are plain data.
 */

const LONGEST_SOURCE = 4_000_000;

/** Texts by their keys. */
const texts: Parse<Record<string, string>> = (value) => {
  const entries = Object.entries(isObject(value) ? value : {}).map(([key, one]) => [key, text(one)] as const);
  return Object.fromEntries(entries.filter(([key, one]) => key !== '__proto__' && one !== undefined)) as Record<string, string>;
};

const POSITION: Shape<Position> = { lat_deg: number(-90, 90), lon_deg: number(-180, 180), alt_m: metres };
const position = object(POSITION, ['lat_deg', 'lon_deg']);
const positions = list(position);

const ages: Parse<Record<string, number>> = (value) => {
  if (!isObject(value)) return undefined;
  const known: [string, number][] = [];
  for (const [key, age] of Object.entries(value)) {
    const parsed = number(-1e9, 1e9)(age); // the station's clock may be a little behind what it has just heard
    if (parsed !== undefined && key !== '__proto__') known.push([key, Math.max(0, parsed)]);
  }
  return Object.fromEntries(known);
};

const updateShape: Shape<VehicleUpdate> = { ...VEHICLE, id: text, age_s: ages };
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

const outcome = object<Command['vehicles'][number]>(
  { vehicle: text, state: text as Parse<never>, reason: text, left_m: metres, rule: text },
  ['vehicle', 'state'],
);
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
  looks_back: object({ session: text }, ['session']),
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
