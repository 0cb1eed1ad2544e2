import { binaryFrame, textFrame, type Frame } from './frame';
import { messageOf, parseObject } from '../lib/wire/parse';
import type { ClientMessage, Hello, Reply, Request, ServerMessage } from '../lib/protocol';

/** What the connection needs of the browser; tests bring their own. */
export interface Socket {
  binaryType?: string;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
  send(text: string): void;
  close(): void;
}

export interface Events {
  opened(): void;
  /** With the feed that it belongs to, if it does. */
  received(message: ServerMessage, feed: string | undefined): void;
  /** A message of a feed, also of one whose messages this app does not know otherwise. */
  arrived(frame: Frame): void;
  /** The feeds that are wanted of those that the station has. */
  wanted(): ReadonlySet<string>;
  /** The station is not there; the next try comes in that many ms. */
  lost(retryInMs: number): void;
}

const FIRST_RETRY_MS = 500;
const LONGEST_RETRY_MS = 10_000;
/** A ping every so often; without any message for the time after it, the station counts as lost even if TCP does not know. */
const PING_MS = 2000;
const SILENCE_MS = 6000;

/** Doubling pauses, bounded, with up to a quarter of chance so that many browsers do not come back at once. */
export function retryDelay(failures: number, chance: number): number {
  return Math.min(LONGEST_RETRY_MS, FIRST_RETRY_MS * 2 ** Math.min(failures, 10)) * (0.75 + 0.25 * chance);
}

/** Keeps one WebSocket to the station, for ever. */
export class Connection {
  private socket: Socket | undefined;
  private isOpen = false;
  private failures = 0;
  private requests = 0;
  private waiting = new Map<string, (reply: Reply) => void>();
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private pingTimer: ReturnType<typeof setInterval> | undefined;
  private lastHeard = 0;
  /** The station's feeds by what binary messages call them; none before its hello. */
  private feeds = new Map<number, string>();
  /** Its run, and what this page has of each feed: only what it missed comes when the station is back. */
  private run = '';
  private readonly revisions = new Map<string, number>();

  constructor(
    private readonly open: () => Socket,
    private readonly events: Events,
    private readonly now: () => number = () => performance.now(),
  ) {}

  connect(): void {
    clearTimeout(this.retryTimer);
    this.drop();
    const socket = this.open();
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.lastHeard = this.now();
    socket.onopen = () => {
      this.isOpen = true;
      this.events.opened();
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => this.retryLater();
    this.pingTimer = setInterval(() => this.watch(), PING_MS);
  }

  /** Gives up until `connect` is called again. */
  stop(): void {
    clearTimeout(this.retryTimer);
    this.drop();
  }

  /** Sends a request and gives the station's reply; a lost station replies with an error too. */
  request(message: Request): Promise<Reply> {
    const id = String(++this.requests);
    if (!this.isOpen) return Promise.resolve(notSent(id));
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.send({ ...message, id });
    });
  }

  private send(message: ClientMessage): void {
    this.socket?.send(JSON.stringify(message));
  }

  /** Tells the station which feeds are wanted. Nothing before its hello: that is answered with the same. */
  subscribe(): void {
    if (!this.isOpen || this.feeds.size === 0) return;
    const wanted = this.events.wanted();
    const feeds = [...this.feeds.values()].filter((name) => wanted.has(name));
    this.send({ type: 'subscribe', id: '', feeds, run: this.run, revisions: Object.fromEntries(this.revisions) });
  }

  private receive(data: unknown): void {
    this.lastHeard = this.now();
    const object = typeof data === 'string' ? parseObject(data) : undefined;
    const message = object && messageOf(object);
    const frame = data instanceof ArrayBuffer ? binaryFrame(data, this.feeds) : object && textFrame(object, message);
    if (message?.type === 'hello') this.greet(message);
    if (message?.type === 'reply') {
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    }
    if (message) this.events.received(message, frame?.feed);
    if (!frame) return;
    this.events.arrived(frame);
    this.revisions.set(frame.feed, frame.revision);
  }

  private greet({ run = '', feeds = [] }: Hello): void {
    this.failures = 0;
    if (run !== this.run) this.revisions.clear();
    this.run = run;
    this.feeds = new Map(feeds.map(({ id, name }) => [id, name]));
    this.subscribe();
  }

  private watch(): void {
    if (this.now() - this.lastHeard > SILENCE_MS) this.retryLater();
    else if (this.isOpen) this.send({ type: 'ping', id: '' });
  }

  private retryLater(): void {
    this.drop();
    const delay = retryDelay(this.failures++, Math.random());
    this.retryTimer = setTimeout(() => this.connect(), delay);
    this.events.lost(delay);
  }

  private drop(): void {
    clearInterval(this.pingTimer);
    this.isOpen = false;
    this.feeds.clear();
    for (const [id, resolve] of this.waiting) resolve(notSent(id));
    this.waiting.clear();
    const socket = this.socket;
    this.socket = undefined;
    if (!socket) return;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close();
  }
}

function notSent(id: string): Reply {
  const error = { message: 'The station did not answer.', hint: 'It may not have heard you: look again when it is back.' };
  return { type: 'reply', id, ok: false, error };
}
