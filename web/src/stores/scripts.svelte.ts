import { parseScripts } from '../lib/wire/parse';
import type { Diagnostic, Reply, Script, ServerMessage, Task } from '../lib/protocol';
import type { ControlStore } from './control.svelte';
import { reasonOf, type Receiver, type Session } from './session.svelte';

/** The script, its tasks, and those in the station's folder. */
export class ScriptsStore implements Receiver {
  readonly feeds = ['script', 'tasks'];
  script = $state.raw<Script>({ name: '', state: 'idle', message: '', source: '', diagnostics: [] });
  trees = $state.raw<Task[]>([]);
  /** Scripts in the station's folder. */
  names = $state.raw<string[]>([]);
  /** Why the last request was refused; empty when it was not. */
  refusal = $state.raw<{ message: string; hint: string; diagnostics: Diagnostic[] } | undefined>(undefined);

  constructor(
    private readonly session: Session,
    private readonly control: ControlStore,
  ) {}

  received(message: ServerMessage): void {
    if (message.type === 'hello') void this.list();
    else if (message.type === 'script') this.script = message;
    else if (message.type === 'tasks') this.trees = message.trees;
  }

  async start(name: string, source: string): Promise<boolean> {
    return this.noteRefusal(await this.session.request({ type: 'start_script', name, source }));
  }

  async stop(): Promise<boolean> {
    const reply = await this.session.request({ type: 'stop_script' });
    if (!reply.ok && this.session.phase !== 'live') this.control.noteStopProblem('STOP', reasonOf(reply));
    return this.noteRefusal(reply);
  }

  /** The text of a script in the station's folder; nothing when it cannot be had, which `refusal` then explains. */
  async open(name: string): Promise<string | undefined> {
    const answer = await this.session.ask(`/api/v1/scripts/text?name=${encodeURIComponent(name)}`);
    if (answer?.ok) return ((await answer.json()) as { source: string }).source;
    const hint = answer ? 'It may have been removed.' : 'The station did not answer.';
    this.refusal = { message: `${name} cannot be opened.`, hint, diagnostics: [] };
    this.session.announce(this.refusal.message);
    return undefined;
  }

  forgetRefusal(): void {
    this.refusal = undefined;
  }

  private async list(): Promise<void> {
    const answer = await this.session.ask('/api/v1/scripts');
    const body: unknown = answer?.ok ? await answer.json().catch(() => undefined) : undefined;
    if (body !== undefined) this.names = parseScripts(body);
  }

  private noteRefusal({ ok, error, diagnostics = [] }: Reply): boolean {
    this.refusal = ok ? undefined : { message: error?.message ?? '', hint: error?.hint ?? '', diagnostics };
    if (this.refusal) this.session.announce(this.refusal.message);
    return ok;
  }
}
