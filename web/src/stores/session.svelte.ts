import { Connection, type Socket } from '../connection/connection';
import type { Frame } from '../connection/frame';
import { sentences } from '../lib/format';
import { PROTOCOL, type Hello, type Position, type Reply, type Request, type ServerMessage } from '../lib/protocol';

/** locked: the station is there and asks for a token that this browser does not have. */
export type Phase = 'connecting' | 'live' | 'lost' | 'locked';

/** What the session needs of the browser; tests bring their own. */
export interface Network {
  open(token: string | undefined): Socket;
  fetch(address: string, init: RequestInit): Promise<Response>;
  readonly token: string | undefined;
  keepToken(token: string): void;
  /** Which moment of what is kept is shown; missing: the present, by this browser's clock. */
  past?(): { session: string; at_ms: number };
}

/** A store that hears what the session hears, in the order in which they were given to it. */
export interface Receiver {
  /** Whose messages it hears. What belongs to no feed, such as the hello, everybody hears. */
  readonly feeds: readonly string[];
  received?(message: ServerMessage, now: number): void;
  lost?(wasLive: boolean): void;
  ticked?(now: number): void;
}

const CLOCK_MS = 500;

/** Whether the station is there, since when nothing came from it, who this viewer is, and the ways to ask it for something. */
export class Session {
  phase = $state<Phase>('connecting');
  /** This browser's clock in ms, ticking slowly, for ages on the screen. */
  now = $state(0);
  lastHeard = $state(0);
  site = $state.raw<Hello['site']>({ name: '' });
  version = $state('');
  /** The session that a station without a present looks back at. */
  looksBackAt = $state('');
  /** What this viewer is called as a commander; empty where vehicles cannot be commanded. */
  operator = $state('');
  /** The last thing to be told at once, for screen readers. */
  alert = $state('');

  private readonly receivers: Receiver[] = [];
  private readonly followers = new Map<string, (frame: Frame) => void>();
  private readonly connection: Connection;
  private readonly clock: ReturnType<typeof setInterval>;
  private token: string | undefined;
  /** The station's clock in s at this browser's 0. */
  private clockOffset_s = 0;
  /** Ends what is asked over HTTP when the station is lost. */
  private asking = new AbortController();

  constructor(private readonly network: Network) {
    this.now = this.lastHeard = this.clockNow();
    this.token = network.token;
    this.connection = new Connection(() => network.open(this.token), {
      opened: () => {},
      received: (message, feed) => this.receive(message, feed),
      arrived: (frame) => this.followers.get(frame.feed)?.(frame),
      wanted: () => new Set([...this.receivers.flatMap(({ feeds }) => feeds), ...this.followers.keys()]),
      lost: () => this.lose(),
    });
    this.clock = setInterval(() => this.tick(), CLOCK_MS);
  }

  /** `receivers` hear everything from now on. */
  begin(receivers: Receiver[]): void {
    this.receivers.push(...receivers);
    this.connection.connect();
  }

  /** One more feed is wanted; all of its messages go to `take`. */
  follow(feed: string, take: (frame: Frame) => void): void {
    this.followers.set(feed, take);
    this.connection.subscribe();
  }

  end(): void {
    clearInterval(this.clock);
    this.connection.stop();
  }

  /** Seconds since anything came from the station. */
  get silence_s(): number {
    return Math.max(0, this.now - this.lastHeard) / 1000;
  }

  /** What is shown is old. */
  get isLost(): boolean {
    return this.phase === 'lost' || this.phase === 'locked';
  }

  /** What is shown was long ago. */
  get isPast(): boolean {
    return this.network.past !== undefined;
  }

  /** Of pictures of what is shown: those of the moment that is. */
  addressThen(address: string): string {
    const moment = this.network.past?.();
    if (!moment) return address;
    const query = `session=${encodeURIComponent(moment.session)}&at_ms=${Math.round(moment.at_ms)}`;
    return `${address}${address.includes('?') ? '&' : '?'}${query}`;
  }

  get hasToken(): boolean {
    return this.token !== undefined;
  }

  /** Where that site's frame begins, if the station has told. */
  anchorOf(site: string): Position | undefined {
    return site === this.site.name ? this.site.origin : undefined;
  }

  /** Seconds until the station's clock shows `time_s`, not less than 0. */
  secondsUntil(time_s: number): number {
    return Math.max(0, time_s - (this.clockOffset_s + this.now / 1000));
  }

  unlock(token: string): void {
    this.token = token;
    this.network.keepToken(token);
    this.phase = 'connecting';
    this.connection.connect();
  }

  retry(): void {
    this.connection.connect();
  }

  announce(words: string): void {
    this.alert = words;
  }

  request(message: Request): Promise<Reply> {
    return this.connection.request(message);
  }

  /** Over HTTP; nothing when the station does not answer. */
  async ask(address: string, init: RequestInit = {}): Promise<Response | undefined> {
    const headers = new Headers(init.headers);
    if (this.token) headers.set('Authorization', `Bearer ${this.token}`);
    try {
      return await this.network.fetch(address, { ...init, headers, signal: this.asking.signal });
    } catch {
      return undefined;
    }
  }

  private clockNow(): number {
    return this.network.past?.().at_ms ?? performance.now();
  }

  private tick(): void {
    this.now = this.clockNow();
    for (const receiver of this.receivers) receiver.ticked?.(this.now);
  }

  private receive(message: ServerMessage, feed: string | undefined): void {
    const now = this.clockNow();
    this.lastHeard = now;
    if (message.type === 'hello') this.greet(message);
    if (message.type === 'vehicles') this.clockOffset_s = message.time_s - now / 1000;
    for (const receiver of this.receivers) if (!feed || receiver.feeds.includes(feed)) receiver.received?.(message, now);
  }

  private greet({ protocol, site, version, operator = '', looks_back }: Hello): void {
    if (this.phase === 'lost') this.announce('The station is back.');
    if (protocol !== PROTOCOL) this.announce(`The station speaks protocol ${protocol}: reload this page.`);
    this.phase = 'live';
    this.site = site;
    this.version = version;
    this.looksBackAt = looks_back?.session ?? '';
    this.operator = operator;
  }

  private lose(): void {
    const wasLive = this.phase === 'live';
    if (wasLive) this.announce('Station lost. The vehicles carry on; what you see is old.');
    if (this.phase !== 'locked') this.phase = 'lost';
    for (const receiver of this.receivers) receiver.lost?.(wasLive);
    this.asking.abort();
    this.asking = new AbortController();
    void this.askWhetherLocked();
  }

  /** A browser does not tell why a WebSocket was refused; the same question over HTTP does. */
  private async askWhetherLocked(): Promise<void> {
    const answer = await this.ask('/api/v1/status');
    if (answer?.status !== 401 || this.phase === 'live') return;
    this.connection.stop();
    this.phase = 'locked';
    this.announce('This station asks for its token.');
  }
}

/** Why a request was refused, and what to do. */
export function reasonOf({ error }: Reply): string {
  return sentences(error?.message, error?.hint);
}
