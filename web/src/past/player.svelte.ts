import { NoPast, type Archive, type KeptFrame, type KeptSession } from './archive';
import type { Hello } from '../lib/protocol';
import { PlayedSocket } from './played_socket';

export const SPEEDS = [0.5, 1, 2, 5, 10, 60] as const;

/** So much of what follows is asked for at a time, in seconds of watching. */
const AHEAD_S = 20;
/** When so little is left of it, more is asked for. */
const LEAST_AHEAD_S = 8;
/** How often a session that still goes on is asked how long it is. */
const REFRESH_MS = 5000;

/** Goes through what a station has shown: from any moment on, at any speed. */
export class Player {
  sessions = $state.raw<readonly KeptSession[]>([]);
  session = $state.raw<KeptSession | undefined>();
  at_ms = $state(0);
  isPlaying = $state(false);
  speed = $state<number>(1);
  /** The moment that was asked for is not there yet. */
  isLoading = $state(false);
  /** Why nothing can be shown. */
  failure = $state('');
  readonly socket = new PlayedSocket();

  /** What comes next, in order, and up to when it is known. */
  private coming: KeptFrame[] = [];
  private known_to_ms = 0;
  private seeks = 0;
  private isAsking = false;
  private sinceRefresh_ms = 0;

  constructor(
    private readonly archive: Archive,
    private readonly site: Hello['site'],
  ) {}

  get began_ms(): number {
    return this.session?.began_ms ?? 0;
  }

  get ended_ms(): number {
    return this.session?.ended_ms ?? 0;
  }

  /** Which sessions there are; shows the newest at that moment, or a minute before its end. */
  async open(at_ms?: number): Promise<void> {
    const newest = await this.find();
    if (newest) await this.seek(at_ms ?? newest.ended_ms - 60_000);
  }

  /** Plays that session from its beginning. */
  async play(id: string): Promise<void> {
    if (!(await this.find(id))) return;
    await this.seek(this.began_ms);
    this.isPlaying = !this.failure;
  }

  /** The newest, where no other is wanted. */
  private async find(wanted?: string): Promise<KeptSession | undefined> {
    await this.guarded(async () => {
      this.sessions = await this.archive.sessions();
      const [newest] = this.sessions;
      if (!newest) throw new NoPast('Nothing is kept yet.');
      this.session = this.sessions.find(({ id }) => id === wanted) ?? newest;
    });
    return this.session;
  }

  async choose(id: string): Promise<void> {
    const session = this.sessions.find((one) => one.id === id);
    if (!session) return;
    this.session = session;
    await this.seek(session.began_ms);
  }

  async seek(at_ms: number): Promise<void> {
    const { session } = this;
    if (!session) return;
    const seek = ++this.seeks;
    this.at_ms = Math.min(Math.max(at_ms, session.began_ms), session.ended_ms);
    this.isLoading = true;
    await this.guarded(async () => {
      const frames = await this.archive.stateAt(session.id, this.at_ms);
      if (seek !== this.seeks) return;
      [this.coming, this.known_to_ms] = [[], this.at_ms + 1];
      this.socket.restart(
        this.site,
        frames.map(({ text }) => text),
      );
    });
    if (seek === this.seeks) this.isLoading = false;
  }

  /** The end of the newest session: the present, where it goes on. */
  async showNewest(): Promise<void> {
    this.isPlaying = false;
    await this.guarded(async () => {
      this.sessions = await this.archive.sessions();
      this.session = this.sessions[0] ?? this.session;
    });
    await this.seek(this.ended_ms);
  }

  /** By so many seconds. */
  step(seconds: number): Promise<void> {
    return this.seek(this.at_ms + seconds * 1000);
  }

  togglePlaying(): void {
    this.isPlaying = !this.isPlaying;
    if (this.isPlaying && this.at_ms >= this.ended_ms) void this.seek(this.began_ms);
  }

  /** So much time has gone by here. */
  advance(elapsed_ms: number): void {
    this.refreshNowAndThen(elapsed_ms);
    if (!this.isPlaying || this.isLoading || !this.session) return;
    // What is not known yet is waited for, rather than left out.
    const wanted = Math.min(this.at_ms + elapsed_ms * this.speed, this.ended_ms);
    this.at_ms = Math.max(this.at_ms, Math.min(wanted, this.known_to_ms - 1));
    const until = this.coming.findIndex(({ at_ms }) => at_ms > this.at_ms);
    const due = this.coming.splice(0, until < 0 ? this.coming.length : until);
    if (due.length > 0) this.socket.play(due.map(({ text }) => text));
    if (this.at_ms >= this.ended_ms) this.isPlaying = false;
    void this.askAhead();
  }

  private async askAhead(): Promise<void> {
    const { session } = this;
    const ahead_s = (this.known_to_ms - this.at_ms) / 1000 / this.speed;
    if (!session || this.isAsking || ahead_s > LEAST_AHEAD_S || this.known_to_ms > this.ended_ms) return;
    const seek = this.seeks;
    this.isAsking = true;
    await this.guarded(async () => {
      const to_ms = Math.min(this.known_to_ms + AHEAD_S * 1000 * this.speed, this.ended_ms + 1);
      const part = await this.archive.between(session.id, this.known_to_ms, to_ms);
      if (seek !== this.seeks) return;
      this.coming.push(...part.frames);
      this.known_to_ms = part.complete_to_ms;
    });
    this.isAsking = false;
  }

  private refreshNowAndThen(elapsed_ms: number): void {
    this.sinceRefresh_ms += elapsed_ms;
    if (this.sinceRefresh_ms < REFRESH_MS) return;
    this.sinceRefresh_ms = 0;
    void this.guarded(async () => {
      this.sessions = await this.archive.sessions();
      this.session = this.sessions.find(({ id }) => id === this.session?.id) ?? this.session;
    });
  }

  private async guarded(work: () => Promise<void>): Promise<void> {
    try {
      await work();
      this.failure = '';
    } catch (reason) {
      if (!(reason instanceof NoPast)) throw reason;
      this.failure = reason.message;
      this.isPlaying = false;
    }
  }
}
