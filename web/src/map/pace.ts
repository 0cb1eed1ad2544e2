/** When the picture of a map takes no longer than that, nothing has to wait. */
const QUICK_MS = 50;
/** Between two differences that a source is given, in pictures: the page has to get on meanwhile. */
const PICTURES = 2;
const MOST_MS = 2000;

/**
 * Keeps what changes often from being drawn as often as a slow machine can. Each difference that a source is given has the whole map drawn
 * anew; a layer of thousands comes in some dozen pieces, and a page that draws each of them has no time to take in the next.
 */
export class Pace {
  /** What the last picture of the map took. */
  private picture_ms = 0;
  private readonly turns = new Map<string, { from: number; work?: () => void }>();

  constructor(
    private readonly now: () => number = () => performance.now(),
    private readonly later: (work: () => void, ms: number) => void = (work, ms) => void setTimeout(work, ms),
  ) {}

  /** The map has begun to draw; whoever calls it calls what it gives when the browser is ready for the next frame. */
  begins(): () => void {
    const begun = this.now();
    return () => (this.picture_ms = this.now() - begun);
  }

  /** Now, or when the map has had time for what it was given last under that name; only the newest work is done then. */
  run(name: string, work: () => void): void {
    const turn = this.turns.get(name) ?? { from: 0 };
    this.turns.set(name, turn);
    const wait = turn.from - this.now();
    if (wait <= 0 && !turn.work) return this.take(turn, work);
    if (!turn.work) this.later(() => this.take(turn, turn.work), wait);
    turn.work = work;
  }

  private take(turn: { from: number; work?: () => void }, work?: () => void): void {
    turn.work = undefined;
    turn.from = this.now() + (this.picture_ms > QUICK_MS ? Math.min(PICTURES * this.picture_ms, MOST_MS) : 0);
    work?.();
  }
}
