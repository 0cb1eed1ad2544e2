import type { LonLat } from './geometry';

/** A little longer than the pause between two messages, so that motion does not stutter. */
const GLIDE_MS = 220;
/** Who jumps further than this is somewhere else. */
const FAR_DEG = 0.01;
/** More of them are seen to move anyway. */
const MOST = 60;
/** A machine that needs longer for a frame has better things to do. */
const SLOW_FRAME_MS = 28;
const PATIENCE = 6;
/** After so long it may try again. */
const REST_MS = 20_000;

interface Way {
  from: LonLat;
  to: LonLat;
  begun: number;
}

/** Has vehicles move evenly from where one message has them to where the next does, on machines that are quick enough. */
export class Glide {
  private readonly ways = new Map<string, Way>();
  private lastFrame = 0;
  private slowFrames = 0;
  private restsUntil = 0;

  /** A new place; `mayGlide` is no for who has asked for less motion. */
  moveTo(id: string, to: LonLat, now: number, mayGlide: boolean): void {
    const way = this.ways.get(id);
    if (way && way.to[0] === to[0] && way.to[1] === to[1]) return;
    const glides = way && mayGlide && now >= this.restsUntil && this.ways.size <= MOST && Math.abs(way.to[0] - to[0]) + Math.abs(way.to[1] - to[1]) < FAR_DEG; // prettier-ignore
    this.ways.set(id, { from: glides ? this.at(id, now)! : to, to, begun: now });
  }

  at(id: string, now: number): LonLat | undefined {
    const way = this.ways.get(id);
    if (!way) return undefined;
    const share = Math.min(1, Math.max(0, (now - way.begun) / GLIDE_MS));
    return [way.from[0] + (way.to[0] - way.from[0]) * share, way.from[1] + (way.to[1] - way.from[1]) * share];
  }

  keepOnly(isPresent: (id: string) => boolean): void {
    for (const id of this.ways.keys()) if (!isPresent(id)) this.ways.delete(id);
  }

  /** Whether somebody is on the way still; to be asked once a frame. */
  goesOn(now: number): boolean {
    const isMoving = [...this.ways.values()].some(
      ({ from, to, begun }) => now - begun < GLIDE_MS && (from[0] !== to[0] || from[1] !== to[1]),
    );
    this.judge(now, isMoving);
    return isMoving;
  }

  private judge(now: number, isMoving: boolean): void {
    const took = now - this.lastFrame;
    this.lastFrame = isMoving ? now : 0;
    if (!isMoving || took > 1000) return;
    this.slowFrames = took > SLOW_FRAME_MS ? this.slowFrames + 1 : Math.max(0, this.slowFrames - 1);
    if (this.slowFrames < PATIENCE) return;
    this.slowFrames = 0;
    this.restsUntil = now + REST_MS;
  }
}
