import { describe, expect, it } from 'vitest';
import { TrailPieces } from '../../layers/trail_pieces';
import { featuresOf, lonLat, pathFeatures } from '../../layers/features';
import { arrange, judgeWith } from '../attention';
import { groupAlarms, knownAlarms } from '../alarms';
import { commandedByOthers, commonModes, requestsTo, stateOf, stopSummary, summaryOf, titleOf } from '../commands';
import { detailsOf } from '../details';
import { addPictures, ageOf, groundSpeed, mergeUpdates, type Fleet } from '../fleet';
import { clock, linkSummary, linkTitle, metres, percent } from '../format';
import { History, linePath, linkShare, rangeOf } from '../places/history';
import { homeDistance, targetOf } from '../places/intent';
import { boundsOf, gridLines } from '../../map/geometry';
import { appendLines, foldCommands, soughtIn } from '../log';
import { objectionsTo } from '../plausibility';
import { parseMessage, parseScripts } from './parse';
import type { Position, ServerMessage } from '../protocol';
import { statusOf, USUAL_LIMITS } from '../status';
import { progressOf, runningLines, wordsOf } from '../tasks';
import { Trails } from '../places/trails';

const parse = (value: unknown): ServerMessage | undefined => parseMessage(JSON.stringify(value));
const vehicles = (...updates: unknown[]) => {
  const message = parse({ type: 'vehicles', time_s: 1, full: false, vehicles: updates });
  if (message?.type !== 'vehicles') throw new Error('no message of vehicles');
  return message.vehicles;
};

describe('what the station sends', () => {
  it('loses an impossible position, and the age of it, but nothing else', () => {
    const position = { lat_deg: 214.748, lon_deg: 0, alt_m: -2_147_484 };
    expect(vehicles({ id: '1', mode: 'AUTO', position, age_s: { position: 0.1, mode: 0.2 } })).toEqual([
      { id: '1', mode: 'AUTO', age_s: { mode: 0.2 } },
    ]);
  });
  it('loses what is no number, too large, or not there', () => {
    const bad = [
      '{"remaining":1e999}',
      '{"remaining":-1.28}',
      '{"remaining":"0.5"}',
      '{"remaining":null}',
      '{}',
      '[]',
      'null',
      '"full"',
      '7',
    ];
    for (const battery of bad) {
      const message = parseMessage(`{"type":"vehicles","time_s":1,"full":true,"vehicles":[{"id":"1","battery":${battery}}]}`);
      expect(message, battery).toMatchObject({ vehicles: [{ id: '1' }] });
      expect(JSON.stringify(message), battery).not.toContain('remaining');
    }
  });
  it('keeps what a vehicle tells a part of, as its protocol has it', () => {
    const fields = {
      hud: { climb_m_s: 1 },
      estimator: { compass: 0.2 },
      radio: { receive_errors: 3 },
      remote_control: { lost: false, channels: 3, pulses_us: [1500, null, 1200] },
    };
    expect(vehicles({ id: '1', ...fields })).toEqual([{ id: '1', ...fields }]);
  });
  it('has no vehicle without an id, and none twice', () => {
    expect(vehicles({ mode: 'AUTO' }, { id: '' }, { id: 3 }, null, [], { id: '1', mode: 'A' }, { id: '1', mode: 'B' })).toEqual([
      { id: '1', mode: 'A' },
    ]);
  });
  it('has no two entries of one key, which a list on the page could not show', () => {
    const message = parse({
      type: 'log',
      lines: [1, 1, 2].map((seq) => ({ seq, time: '', level: 'shout', source: 'a', text: 'b' })),
    });
    expect(message).toMatchObject({ lines: [{ seq: 1, level: 'info' }, { seq: 2 }] });
  });
  it('cannot reach into objects of the page', () => {
    for (const type of ['constructor', '__proto__', 'toString', 'hasOwnProperty']) expect(parse({ type })).toBeUndefined();
    const message = parseMessage(
      '{"type":"vehicles","time_s":1,"full":true,"vehicles":[{"id":"1","__proto__":{"armed":true},"age_s":{"__proto__":1}}]}',
    );
    expect(message).toMatchObject({ vehicles: [{ id: '1' }] });
    expect(message?.type === 'vehicles' && message.vehicles[0]?.armed).toBeUndefined();
  });
  it('may be nested deeply without an end of the page', () => {
    const deep = (inner: string, depth: number): string =>
      '{"id":1,"kind":"a","label":"","line":1,"state":"running","children":['.repeat(depth) + inner + ']}'.repeat(depth);
    const message = parseMessage(`{"type":"tasks","trees":[${deep('', 3000)}]}`);
    expect(message?.type).toBe('tasks');
    if (message?.type === 'tasks') expect(runningLines(message.trees)).toEqual(new Set([1]));
    expect(() =>
      parseMessage(`{"type":"vehicles","time_s":1,"full":true,"vehicles":[{"id":"1","new_key":${'['.repeat(9000)}${']'.repeat(9000)}}]}`),
    ).not.toThrow();
  });
  it('may have keys that this app does not know', () => {
    expect(vehicles({ id: '1', mood: { good: true, left: 3, note: 'x' } })).toEqual([
      { id: '1', mood: { good: true, left: 3, note: 'x' } },
    ]);
  });
});

/** Mulberry32: the same seed, the same messages. */
function lottery(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4_294_967_296;
  };
}

const ODD = [
  0,
  -0,
  -1,
  1,
  0.5,
  90,
  91,
  -91,
  180,
  181,
  214.7483647,
  -214.7483648,
  2_147_483_647,
  -2_147_483_648,
  4_294_967_295,
  1e21,
  -1e21,
  1.7e308,
  Number.MIN_VALUE,
  65_535,
  1e-7,
];
const WORDS = [
  '',
  '1',
  '2',
  'copter',
  'AUTO',
  'lost',
  'ok',
  'conflict',
  'constructor',
  '__proto__',
  'running',
  'confirmed',
  'critical',
  'x'.repeat(3000),
  '\u0000\u202e<img src=x>',
  'NaN',
  '2026-13-99',
];
const SAMPLES: Record<string, unknown>[] = [
  {
    type: 'hello',
    operator: 'operator 1',
    protocol: 1,
    version: '1',
    server_time: '',
    site: { name: 'a', origin: { lat_deg: 1, lon_deg: 2, alt_m: 3 }, tiles: '' },
  },
  {
    type: 'vehicles',
    time_s: 5,
    full: true,
    vehicles: ['1', '2'].map((id) => ({
      id,
      system_id: 1,
      name: 'copter 1',
      family: 'copter',
      autopilot: 'px4',
      connection: 'ok',
      links: [{ name: 'udp', loss: 0.1, messages_per_s: 3, bytes_per_s: 5, round_trip_s: 0.1, alive: true, used: true }],
      silent: false,
      mode: 'AUTO',
      armed: true,
      landed: false,
      position: { lat_deg: 41, lon_deg: -8, alt_m: 100 },
      relative_alt_m: 20,
      velocity_m_s: { north: 1, east: 2, down: 0 },
      heading_rad: 1,
      battery: { remaining: 0.5, voltage_v: 12, current_a: 3, consumed_ah: 1, time_left_s: 300, time_left_is_estimate: true },
      further_batteries: [{ id: 1, remaining: 0.2, time_left_s: 10 }],
      gps: { fix: '3D', satellites: 10, hdop: 0.7 },
      estimator: { velocity: 0.1, position_horizontal: 0.1, position_vertical: 0.1, compass: 0.1 },
      unhealthy: ['compass'],
      arming_reasons: ['PreArm: x'],
      remote_control: { lost: false, channels: 8, rssi: 0.5, pulses_us: [1500] },
      radio: { rssi: 1, remote_rssi: 2, noise: 3, remote_noise: 4, buffer_free: 0.5, receive_errors: 0 },
      hud: { airspeed_m_s: 3, climb_m_s: 1, throttle: 0.5 },
      wind: { from_rad: 1, speed_m_s: 3 },
      fence: { breached: true, breaches: 1, type: 'boundary' },
      health: { position_ok: true, prearm_ok: true },
      home: { lat_deg: 41, lon_deg: -8, alt_m: 100 },
      mission: { current: 1, total: 3, complete: false, state: 'active' },
      waypoint_distance_m: 40,
      gimbal: { roll_rad: 0, pitch_rad: -1, yaw_rad: 0, yaw_is_from_north: true },
      components: [{ id: 100, kind: 'camera', state: 'active', model: 'M' }],
      pictures: { taken: 1, lost: 0 },
      texts: [{ severity: 4, text: 'hello', component: 1 }],
      control: { commander: 'operator 1', asked_for_by: 'operator 2', granted_at_s: 9 },
      foreign_change: 'x',
      age_s: { heartbeat: 0.1, position: 0.1, component_100: 3 },
    })),
  },
  {
    type: 'plan',
    vehicle: '1',
    path: [
      { lat_deg: 41, lon_deg: -8, alt_m: 1 },
      { lat_deg: 42, lon_deg: -8, alt_m: 1 },
    ],
  },
  { type: 'pictures', vehicle: '1', full: false, pictures: [{ number: 1, lat_deg: 41, lon_deg: -8, alt_m: 1, relative_alt_m: 2 }] },
  {
    type: 'tasks',
    trees: [
      { id: 1, kind: 'a', label: 'b', line: 1, state: 'running', children: [{ id: 2, kind: 'c', label: 'd', line: 2, state: 'done' }] },
    ],
  },
  {
    type: 'script',
    name: 'a',
    state: 'running',
    message: '',
    source: 'x',
    diagnostics: [{ severity: 'error', file: 'a', line: 1, column: 1, end_line: 1, end_column: 2, message: 'm' }],
  },
  { type: 'log', lines: [{ seq: 1, time: '2026-01-01T00:00:00Z', level: 'info', source: 'a', text: 'b' }] },
  {
    type: 'emergency',
    latched: true,
    action: 'hold',
    by: 'x',
    since: '',
    vehicles: [{ vehicle: '1', acknowledged: true, confirmed: false, tries: 1, detail: '' }],
  },
  {
    type: 'commands',
    commands: [
      {
        number: 1,
        action: 'go_to',
        by: 'x',
        asked: '',
        height_m: 10,
        place: { lat_deg: 1, lon_deg: 1, alt_m: 1 },
        mode: '',
        allow: { ceiling: 'x' },
        vehicles: [{ vehicle: '1', state: 'refused', reason: 'x [too_far]', rule: 'too_far' }],
      },
    ],
  },
  {
    type: 'alarms',
    battery: { low: 0.3, critical: 0.1 },
    alarms: [{ number: 1, kind: 'silent', severity: 'critical', vehicle: '1', text: 'x', raised: '', age_s: 3 }],
  },
  { type: 'reply', id: '1', ok: false, error: { message: 'a', hint: 'b' }, diagnostics: [] },
];

/** The sample with some of its values replaced by odd ones, dropped, doubled or put into each other's places. */
function spoilt(value: unknown, draw: () => number, share: number): unknown {
  if (draw() < share) return odd(draw);
  if (Array.isArray(value)) {
    const entries = value.map((one) => spoilt(one, draw, share));
    return draw() < share * 2 ? [...entries, ...entries, odd(draw)] : entries;
  }
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(
    Object.entries(value).flatMap(([key, one]) => (draw() < share / 2 ? [] : [[key, key === 'type' ? one : spoilt(one, draw, share)]])),
  );
}
function odd(draw: () => number): unknown {
  const from = <T>(choices: T[]): T => choices[Math.floor(draw() * choices.length)]!;
  return from<() => unknown>([
    () => from(ODD),
    () => from(ODD),
    () => from(WORDS),
    () => null,
    () => true,
    () => [],
    () => ({}),
    () => [from(ODD), from(WORDS)],
    () => ({ lat_deg: from(ODD), lon_deg: from(ODD) }),
    () => from(SAMPLES),
  ])();
}

/** Everything that the page computes from what it knows; throws where the page would. */
class Page {
  fleet: Fleet = new Map();
  trails = new Trails();
  history = new History();
  now = 0;
  plans = new Map<string, Position[]>();
  pictures: ReturnType<typeof addPictures> = new Map();

  receive(message: ServerMessage): void {
    switch (message.type) {
      case 'vehicles':
        this.fleet = mergeUpdates(this.fleet, message.vehicles, message.full, 1000, () => ({ lat_deg: 41, lon_deg: -8, alt_m: 90 }));
        this.history.note(this.fleet.values(), (this.now += 1000));
        this.trails.grow(this.fleet.values());
        break;
      case 'plan':
        this.plans.set(message.vehicle, message.path);
        break;
      case 'pictures':
        this.pictures = addPictures(this.pictures, message.vehicle, message.pictures, message.full);
        break;
      case 'tasks':
        progressOf(message.trees);
        runningLines(message.trees);
        message.trees.forEach(wordsOf);
        break;
      case 'log':
        soughtIn(foldCommands(appendLines([], message.lines, 0)), {
          lowest: 'info',
          words: '',
          vehicles: [{ id: '1', name: 'copter (1' }],
        }).forEach(({ first }) => clock(first.time));
        break;
      case 'emergency':
        stopSummary(message);
        break;
      case 'commands':
        for (const command of message.commands)
          void [
            titleOf(command),
            [...this.fleet.values()].map((vehicle) => targetOf(vehicle, message.commands, this.plans.get(vehicle.id))),
            objectionsTo(command, message.commands, 'x'),
            Object.values(command.allow ?? {}).join(),
            summaryOf(command),
            command.vehicles.map(({ state }) => stateOf(state, command.action).word),
          ];
        break;
      case 'alarms':
        groupAlarms(knownAlarms(message.alarms, 1000), (id) => id);
        break;
      default:
        break;
    }
  }

  show(): string[] {
    const all = [...this.fleet.values()];
    const shown = all.flatMap((vehicle) => [
      statusOf(vehicle, false).word,
      ...detailsOf(vehicle, 2000).flatMap(({ rows }) => rows.map(({ value }) => value)),
      linkSummary(vehicle.fields.links),
      linkTitle(vehicle.fields.links) ?? '',
      metres(vehicle.fields.relative_alt_m),
      String(groundSpeed(vehicle) ?? ''),
      percent(linkShare(vehicle)),
      metres(homeDistance(vehicle)),
      linePath(
        this.history.of(vehicle.id).map(({ height_m }) => height_m),
        300,
        rangeOf(
          this.history.of(vehicle.id).map(({ height_m }) => height_m),
          10,
        ),
        100,
        20,
      ),
      String(ageOf(vehicle, 'heartbeat', 2000) ?? ''),
    ]);
    arrange(all, { words: 'copter', grouping: 'kind', order: 'attention' }, judgeWith(false, USUAL_LIMITS));
    commandedByOthers(all, 'operator 1');
    requestsTo(all, 'operator 1');
    commonModes(all);
    const features = [
      pathFeatures(this.plans, () => 'red'),
      new TrailPieces().settle([...this.trails.entries()], () => 'red', true),
      featuresOf([...this.pictures.values()].flat().map((place) => ({ properties: {}, point: lonLat(place) }))),
    ];
    const places = all.flatMap(({ fields }) => fields.position ?? []);
    const bounds = boundsOf(places, 60);
    if (bounds) shown.push(...Object.values(bounds).map(String), String(gridLines(bounds, places[0], 12).length));
    return [...shown, ...features.map((feature) => JSON.stringify(feature))];
  }
}

it('lists scripts by name, each once', () => {
  expect(parseScripts({ scripts: [{ name: 'a' }, { name: 'a' }, null, { name: 3 }, { name: 'b' }] })).toEqual(['a', 'b']);
  for (const body of [null, 3, [], { scripts: 'all' }]) expect(parseScripts(body)).toEqual([]);
});

it('shows a state of a command by its own word when it does not know it', () => {
  for (const state of ['levitating', 'constructor']) expect(stateOf(state as never, 'arm').word).toBe(state);
});

it('never breaks the page, nor shows what is no number, whatever the station sends', { timeout: 60_000 }, () => {
  const draw = lottery(20_261_122);
  const page = new Page();
  let taken = 0;
  for (let turn = 0; turn < 2500; ++turn) {
    const sample = SAMPLES[Math.floor(draw() * SAMPLES.length)]!;
    const data = JSON.stringify(spoilt(sample, draw, draw() < 0.2 ? 0 : draw() * 0.3));
    const message = parseMessage(data);
    if (!message) continue;
    taken += 1;
    const told = () => `turn ${turn}: ${data.slice(0, 2000)}`;
    try {
      page.receive(message);
      if (turn % 10 === 0)
        for (const text of page.show())
          if (/NaN|Infinity|undefined|\[object/.test(text.replace('x'.repeat(3000), '')) && !WORDS.includes(text))
            throw new Error(`shows ${text.slice(0, 300)}`);
    } catch (error) {
      throw new Error(`${String(error)} at ${told()}`, { cause: error });
    }
  }
  expect(taken).toBeGreaterThan(1200);
  // One that is sound is shown as ever, after all of that.
  page.receive(parse(SAMPLES[1])!);
  expect(page.fleet.get('1')?.fields.position).toEqual({ lat_deg: 41, lon_deg: -8, alt_m: 100 });
});
