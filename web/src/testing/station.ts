import { flushSync } from 'svelte';
import type { Socket } from '../connection/connection';
import type { ClientMessage, Hello, Reply, Request, ServerMessage, VehicleUpdate } from '../lib/protocol';
import { contextOf, createStores, type Stores } from '../stores/stores';

/** A station in memory: it says what a test has it say, and keeps what it is asked. */
export class TestStation {
  /** What the page has asked, without its pings. */
  readonly asked: Request[] = [];
  /** The feeds that it has asked for last. */
  subscribed: string[] = [];
  /** What it answers over HTTP, by the path of the address. */
  readonly files = new Map<string, Response>();
  /** What was posted to it over HTTP. */
  readonly posted: { address: string; body: unknown }[] = [];
  /** What was said aloud or sounded. */
  readonly sounds: string[] = [];
  readonly stores: Stores;
  /** For `render`. */
  readonly context: Map<string, Stores>;
  private socket: Socket | undefined;
  private waiting: string[] = [];

  constructor(token?: string) {
    const voices = {
      beep: () => this.sounds.push('tone'),
      speak: (text: string) => this.sounds.push(text),
      wake: () => {},
      isMuted: false,
    };
    this.stores = createStores(
      { open: () => this.connect(), fetch: (address, init) => this.answer(address, init), token, keepToken: () => {} },
      voices,
    );
    this.context = contextOf(this.stores);
  }

  /** As a station that greets its viewer, and knows these vehicles. */
  static live(vehicles: VehicleUpdate[] = [], hello: Partial<Hello> = {}): TestStation {
    const station = new TestStation();
    station.socket?.onopen?.();
    const usual = { protocol: 1, version: '0.1.0', server_time: '2026-05-01T12:00:00Z', operator: 'operator 1', site: { name: 'field' } };
    station.tell({ type: 'hello', ...usual, ...hello }, { type: 'vehicles', time_s: 100, full: true, vehicles });
    return station;
  }

  tell(...messages: ServerMessage[]): void {
    for (const message of messages) this.socket?.onmessage?.({ data: JSON.stringify(message) });
    flushSync();
  }

  tellBytes(data: ArrayBuffer): void {
    this.socket?.onmessage?.({ data });
    flushSync();
  }

  /** Answers the oldest request that waits. */
  async reply(reply: Partial<Reply> = {}): Promise<void> {
    this.tell({ type: 'reply', id: this.waiting.shift() ?? '', ok: true, ...reply });
    await Promise.resolve();
    flushSync();
  }

  /** The connection ends. */
  goAway(): void {
    this.socket?.onclose?.();
    flushSync();
  }

  end(): void {
    this.stores.session.end();
  }

  private connect(): Socket {
    const send = (text: string): void => {
      const { id, ...request } = JSON.parse(text) as ClientMessage;
      if (request.type === 'subscribe') this.subscribed = request.feeds;
      if (request.type === 'ping' || request.type === 'subscribe') return;
      this.asked.push(request);
      this.waiting.push(id);
    };
    const socket: Socket = { onopen: null, onmessage: null, onclose: null, send, close: () => {} };
    this.socket = socket;
    return socket;
  }

  private answer(address: string, { method, body }: RequestInit): Promise<Response> {
    if (method === 'POST') this.posted.push({ address, body: typeof body === 'string' ? JSON.parse(body) : body });
    const found = this.files.get(address.split('?')[0] ?? '');
    return found ? Promise.resolve(found.clone()) : Promise.reject(new Error(`nobody answers ${address}`));
  }
}

/** A copter that is well. */
export function copter(id: string, more: Partial<VehicleUpdate> = {}): VehicleUpdate {
  return {
    id,
    name: `copter ${id}`,
    family: 'copter',
    autopilot: 'ardupilot',
    connection: 'ok',
    mode: 'GUIDED',
    armed: false,
    landed: true,
    position: { lat_deg: -35.36, lon_deg: 149.16, alt_m: 584 },
    relative_alt_m: 0,
    health: { position_ok: true, prearm_ok: true },
    age_s: { heartbeat: 0.2 },
    ...more,
  };
}
