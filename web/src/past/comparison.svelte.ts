import { NoPast, type Archive, type KeptMoment } from './archive';
import type { Changes } from './changes';
import type { Player } from './player.svelte';

/** Compares the moment that is shown with another one, which the operator has marked. */
export class Comparison {
  /** The earlier of the two, usually: where it was begun. Nothing: nothing is compared. */
  marked = $state.raw<KeptMoment | undefined>();
  isLoading = $state(false);
  failure = $state('');
  private asked = 0;

  constructor(
    private readonly archive: Pick<Archive, 'changes'>,
    private readonly player: Player,
    private readonly show: (changes: Changes | undefined) => void,
  ) {}

  get isOn(): boolean {
    return this.marked !== undefined;
  }

  /** From the moment that is shown on. */
  begin(): void {
    const { session, at_ms } = this.player;
    if (session) this.mark({ session: session.id, at_ms });
  }

  mark(moment: KeptMoment): void {
    this.marked = moment;
    this.failure = '';
  }

  end(): void {
    this.asked += 1;
    [this.marked, this.failure, this.isLoading] = [undefined, '', false];
    this.show(undefined);
  }

  /** Shows how it ended: of a session that goes on, how it is now. */
  async compareWithNow(): Promise<void> {
    if (!this.marked) this.begin();
    await this.player.showNewest();
  }

  /** Asks what has changed between the mark and what is shown. */
  async compare(): Promise<void> {
    const { marked } = this;
    const { session, at_ms, isPlaying } = this.player;
    if (!marked || !session || isPlaying) return;
    const asked = ++this.asked;
    const shown = { session: session.id, at_ms };
    this.isLoading = true;
    try {
      const isForwards = marked.session !== shown.session || marked.at_ms <= shown.at_ms;
      const changes = await (isForwards ? this.archive.changes(marked, shown) : this.archive.changes(shown, marked));
      if (asked !== this.asked) return;
      this.failure = '';
      this.show(changes);
    } catch (reason) {
      if (!(reason instanceof NoPast)) throw reason;
      if (asked === this.asked) this.failure = reason.message;
    } finally {
      if (asked === this.asked) this.isLoading = false;
    }
  }
}
