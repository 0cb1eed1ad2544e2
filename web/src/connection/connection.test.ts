import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Connection, retryDelay, type Socket } from './connection';
import type { Frame } from './frame';
import { parseMessage } from '../lib/wire/parse';
import type { ServerMessage } from '../lib/protocol';

class MemorySocket implements Socket {
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  binaryType = 'blob';
  sent: ({ type: string; id: string } & Record<string, unknown>)[] = [];
  isClosed = false;
  send(text: string): void {
    this.sent.push(JSON.parse(text) as MemorySocket['sent'][number]);
  }
  close(): void {
    this.isClosed = true;
  }
}

let sockets: MemorySocket[];
let received: ServerMessage[];
let arrived: Frame[];
let wanted: Set<string>;
let lost: number[];
let connection: Connection;

beforeEach(() => {
  vi.useFakeTimers();
  sockets = [];
  received = [];
  arrived = [];
  wanted = new Set(['log', 'map']);
  lost = [];
  const open = () => sockets[sockets.push(new MemorySocket()) - 1]!;
  const events = {
    opened: () => {},
    received: (message: ServerMessage) => received.push(message),
    arrived: (frame: Frame) => arrived.push(frame),
    wanted: () => wanted,
    lost: (ms: number) => lost.push(ms),
  };
  connection = new Connection(open, events, () => Date.now());
  connection.connect();
});
afterEach(() => vi.useRealTimers());

const last = () => sockets.at(-1)!;
const tell = (message: object) => last().onmessage!({ data: JSON.stringify(message) });

describe('Connection', () => {
  it('hands on messages and skips rubbish', () => {
    tell({ type: 'tasks', trees: [] });
    last().onmessage!({ data: 'rubbish' });
    last().onmessage!({ data: new ArrayBuffer(2) });
    expect(received).toEqual([{ type: 'tasks', trees: [] }]);
  });

  it('hands on what belongs to a feed with its name, bytes too', () => {
    tell({ type: 'hello', run: 'a', feeds: [{ name: 'map', id: 9 }] });
    tell({ type: 'tasks', trees: [], feed: 'tasks', revision: 3 });
    tell({ type: 'weather', wind: 3, feed: 'weather', revision: 4 });
    last().onmessage!({ data: new Uint8Array([1, 1, 9, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0x78]).buffer });
    expect(last().binaryType).toBe('arraybuffer');
    expect(received.map(({ type }) => type)).toEqual(['hello', 'tasks']);
    expect(arrived.map(({ feed, revision }) => [feed, revision])).toEqual([
      ['tasks', 3],
      ['weather', 4],
      ['map', 2],
    ]);
    expect(arrived[2]!.content).toEqual(new Uint8Array([0x78]));
  });

  it('subscribes to what is wanted, and asks a station that is back for what it missed', () => {
    const hello = (run: string): void => {
      last().onopen!();
      tell({ type: 'hello', run, feeds: ['log', 'map', 'other'].map((name, id) => ({ name, id })) });
    };
    const asked = (): object => last().sent.at(-1)!;
    hello('a');
    expect(asked()).toEqual({ type: 'subscribe', id: '', feeds: ['log', 'map'], run: 'a', revisions: {} });
    tell({ type: 'log', lines: [], feed: 'log', revision: 12 });
    wanted.add('other');
    connection.subscribe();
    expect(asked()).toMatchObject({ feeds: ['log', 'map', 'other'], revisions: { log: 12 } });

    last().onclose!();
    connection.subscribe();
    vi.advanceTimersByTime(2500);
    hello('a');
    expect(last().sent).toHaveLength(1);
    expect(asked()).toMatchObject({ run: 'a', revisions: { log: 12 } });

    last().onclose!();
    vi.advanceTimersByTime(2500);
    hello('b');
    expect(asked()).toMatchObject({ run: 'b', revisions: {} });
  });

  it('asks a station without feeds for nothing', () => {
    last().onopen!();
    tell({ type: 'hello' });
    expect(last().sent).toEqual([]);
  });

  it('connects again after ever longer pauses, and starts over after a hello', () => {
    for (let i = 0; i < 3; ++i) {
      last().onclose!();
      vi.advanceTimersByTime(2500);
    }
    expect(sockets).toHaveLength(4);
    expect(lost[2]!).toBeGreaterThan(lost[0]!);
    tell({ type: 'hello' });
    last().onclose!();
    expect(lost[3]!).toBeLessThanOrEqual(500);
  });

  it('counts a silent station as lost', () => {
    last().onopen!();
    vi.advanceTimersByTime(2000);
    expect(last().sent[0]?.type).toBe('ping');
    vi.advanceTimersByTime(6100);
    expect(lost.length).toBeGreaterThan(0);
    expect(sockets[0]!.isClosed).toBe(true);
  });

  it('gives each request its reply', async () => {
    last().onopen!();
    const first = connection.request({ type: 'stop_script' });
    const second = connection.request({ type: 'start_script', name: 'n', source: 's' });
    const [a, b] = last().sent;
    tell({ type: 'reply', id: b!.id, ok: false, error: { message: 'no', hint: '' } });
    tell({ type: 'reply', id: a!.id, ok: true });
    expect((await first).ok).toBe(true);
    expect((await second).error?.message).toBe('no');
  });

  it('answers requests itself when the station is not there or goes away', async () => {
    expect((await connection.request({ type: 'stop_script' })).ok).toBe(false);
    last().onopen!();
    const asked = connection.request({ type: 'stop_script' });
    last().onclose!();
    expect((await asked).error?.message).toContain('did not answer');
  });

  it('tries at once when told to, on one socket only', () => {
    last().onclose!();
    connection.connect();
    expect(sockets).toHaveLength(2);
    vi.advanceTimersByTime(1000);
    expect(sockets).toHaveLength(2);
  });
});

it('bounds the pauses', () => {
  expect(retryDelay(0, 0)).toBe(375);
  expect(retryDelay(100, 1)).toBe(10_000);
});

it('parses only objects with a type', () => {
  expect(parseMessage('{"type":"pong"}')).toEqual({ type: 'pong' });
  for (const text of ['', '[]', '3', 'null', '{"type":3}', '{']) expect(parseMessage(text)).toBeUndefined();
});
