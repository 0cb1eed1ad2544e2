import { appendLines } from '../lib/log';
import type { LogLine, ServerMessage } from '../lib/protocol';
import type { Receiver, Session } from './session.svelte';

/** What the station has told, the newest last. */
export class LogStore implements Receiver {
  readonly feeds = ['log'];
  lines = $state.raw<LogLine[]>([]);
  private lastSeq = 0;

  constructor(private readonly session: Session) {}

  received(message: ServerMessage): void {
    if (message.type === 'log') this.add(message.lines);
  }

  private add(lines: LogLine[]): void {
    const newest = lines.at(-1)?.seq ?? 0;
    if (newest < this.lastSeq) this.lastSeq = 0; // the station was started anew
    const before = this.lines.length;
    this.lines = appendLines(this.lines, lines, this.lastSeq);
    // Alarms are told by themselves.
    const failure = lines.findLast((line) => line.level === 'error' && line.seq > this.lastSeq && line.source !== 'alarm');
    if (failure && before > 0) this.session.announce(`${failure.source}: ${failure.text}`);
    this.lastSeq = newest;
  }
}
