/** When the picture of a map takes no longer than that, nothing has to wait. */
const QUICK_MS = 20;
/** Between two turns, in pictures: the page has to get on meanwhile. */
const PICTURES = 2;
const MOST_MS = 2000;
/** What the station tells in one round comes as several messages. */
const ROUND_MS = 10;
/** Much comes in pieces: so long after the last of them nothing more is on its way, and for so long at most it is waited for. */
const CALM_MS = 120;
const MOST_CALM_MS = 1500;

/**
 * Keeps what changes often from being drawn as often as a slow machine can. Each difference that a source is given has the whole map drawn
 * anew, and a page that draws has no time to take in the next message. So differences of all sources have their turns together, two
 * pictures apart; and a layer of thousands, which comes in some dozen pieces, is drawn when all of them are there.
 */
export class Pace {
  /** What the last picture of the map took. */
  private picture_ms = 0;
  private readonly waiting = new Map<string, () => void>();
  /** The next turn, and whether somebody looks whether it has come. */
  private turn = 0;
  private isDue = false;
  /** When much began to come. */
  private muchSince: number | undefined;

  constructor(
    private readonly now: () => number = () => performance.now(),
    private readonly later: (work: () => void, ms: number) => void = (work, ms) => void setTimeout(work, ms),
  ) {}

  /** Whether a picture takes so long that those that nobody needs are to be spared. */
  get isSlow(): boolean {
    return this.picture_ms > QUICK_MS;
  }

  /** The map has begun to draw; whoever calls it calls what it gives when the browser is ready for the next frame. */
  begins(): () => void {
    const begun = this.now();
    return () => (this.picture_ms = this.now() - begun);
  }

  /**
   * At the next turn, which on a quick machine is now; only the newest work by that name is done then. `isMuch` where one message has
   * brought so much that more of it is on its way.
   */
  run(name: string, work: () => void, isMuch = false): void {
    const now = this.now();
    this.waiting.set(name, work);
    if (isMuch) {
      this.muchSince ??= now;
      this.turn = Math.max(this.turn, Math.min(now + CALM_MS, this.muchSince + MOST_CALM_MS));
    } else if (this.waiting.size === 1 && this.isSlow) {
      this.turn = Math.max(this.turn, now + ROUND_MS);
    }
    this.look();
  }

  /** The map is gone: nothing that waits is done any more. */
  end(): void {
    this.waiting.clear();
  }

  private look(): void {
    if (this.isDue || this.waiting.size === 0) return;
    const wait = this.turn - this.now();
    if (wait <= 0) return this.take();
    this.isDue = true;
    this.later(() => ((this.isDue = false), this.look()), wait);
  }

  private take(): void {
    const works = [...this.waiting.values()];
    this.waiting.clear();
    this.muchSince = undefined;
    this.turn = this.now() + (this.isSlow ? Math.min(PICTURES * this.picture_ms, MOST_MS) : 0);
    for (const work of works) work();
  }
}

/**
 * Calls `drawn` when what was given to be drawn so far is drawn. The browser hands a picture to a process that draws, and takes the next one
 * meanwhile: how soon the page may go on says little about how long a picture takes. A context that is lost draws nothing more.
 */
export function whenDrawn(
  gl: WebGL2RenderingContext,
  drawn: () => void,
  nextFrame: (look: () => void) => void = requestAnimationFrame,
): void {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!fence) return drawn();
  gl.flush();
  const look = (): void => {
    if (!gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) return nextFrame(look);
    gl.deleteSync(fence);
    drawn();
  };
  nextFrame(look);
}
