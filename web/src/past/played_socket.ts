import type { Socket } from '../connection/connection';
import { PROTOCOL, type Hello } from '../lib/protocol';

/** What stands where the station's socket would: it says again what the station has said, and asks nobody anything. */
export class PlayedSocket implements Socket {
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  private runs = 0;

  /** As a station that has just begun: whoever listens forgets what it had. */
  restart(site: Hello['site'], frames: readonly string[]): void {
    this.onopen?.();
    this.runs += 1;
    // Without the name of an operator nothing can be commanded: it would be too late.
    this.say(JSON.stringify({ type: 'hello', protocol: PROTOCOL, version: '', server_time: '', site, run: `past ${this.runs}` }));
    this.play(frames);
  }

  play(frames: readonly string[]): void {
    for (const text of frames) this.say(text);
  }

  send(text: string): void {
    const { type, id } = JSON.parse(text) as { type: string; id: string };
    if (type === 'subscribe') return;
    // The page watches that somebody is there.
    if (type === 'ping') return this.say(JSON.stringify({ type: 'pong', id, server_time: '' }));
    this.say(
      JSON.stringify({
        type: 'reply',
        id,
        ok: false,
        error: { message: 'This is the past.', hint: 'Go back to live to command vehicles.' },
      }),
    );
  }

  close(): void {
    this.onmessage = null;
  }

  private say(data: string): void {
    this.onmessage?.({ data });
  }
}
