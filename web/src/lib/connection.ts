import { parseMessage } from './parse';
import type { ClientMessage, Reply, Request, ServerMessage } from './protocol';

/** What the connection needs of the browser; tests bring their own. */
export interface Socket {
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
  send(text: string): void;
  close(): void;
}

export interface Events {
  opened(): void;
  received(message: ServerMessage): void;
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

  constructor(
    private readonly open: () => Socket,
    private readonly events: Events,
    private readonly now: () => number = () => performance.now(),
  ) {}

  connect(): void {
    clearTimeout(this.retryTimer);
    this.drop();
    const socket = this.open();
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

  private receive(data: unknown): void {
    this.lastHeard = this.now();
    const message = typeof data === 'string' ? parseMessage(data) : undefined;
    if (!message) return;
    if (message.type === 'hello') this.failures = 0;
    if (message.type === 'reply') {
      this.waiting.get(message.id)?.(message);
      this.waiting.delete(message.id);
    }
    this.events.received(message);
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
