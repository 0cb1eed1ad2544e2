import type { GeoJSONSourceDiff } from 'maplibre-gl';
import type { Trail } from '../lib/places/trails';
import type { LonLat } from '../map/geometry';
import { featureOf, lonLat, type Mark } from './features';

/** So many points may gather at the ends, and so many more a vehicle: below it, sending them all is cheaper than a new piece of each. */
const FEW = 1000;
const FEW_A_VEHICLE = 30;

/** A part of a trail that does not change any more. */
interface Piece {
  feature: number;
  /** The number of its last point. */
  to: number;
}

/** Which points of the trails have been sent as pieces, and which are their ends. Two pieces that follow each other share a point. */
export class TrailPieces {
  private readonly pieces = new Map<Trail, Piece[]>();
  private lastFeature = 0;

  /** Whether too much has gathered at the ends, or a trail is gone whose pieces are still there. */
  wantSettling(trails: [string, Trail][]): boolean {
    const present = new Set(trails.map(([, trail]) => trail));
    const gathered = trails.reduce((sum, [, trail]) => sum + trail.first + trail.points.length - this.settledTo(trail), 0);
    return gathered > FEW + FEW_A_VEHICLE * trails.length || [...this.pieces.keys()].some((trail) => !present.has(trail));
  }

  /** What has gathered becomes pieces. With `isAnew` each trail becomes one piece, and nothing of what was there stays. */
  settle(trails: [string, Trail][], colourOf: (id: string) => string, isAnew: boolean): GeoJSONSourceDiff {
    const remove = isAnew ? [] : this.forgetOld(new Set(trails.map(([, trail]) => trail)));
    if (isAnew) this.pieces.clear();
    const add = trails.flatMap(([id, trail]) => {
      const mark = this.endOf(id, trail, colourOf);
      const feature = featureOf({ ...mark, id: this.lastFeature + 1 });
      if (!feature) return [];
      this.lastFeature += 1;
      const piece = { feature: this.lastFeature, to: trail.first + trail.points.length - 1 };
      this.pieces.set(trail, [...(this.pieces.get(trail) ?? []), piece]);
      return [feature];
    });
    return { removeAll: isAnew, remove, add };
  }

  /** What is not in any piece yet, each joined to the last of them. */
  ends(trails: [string, Trail][], colourOf: (id: string) => string): { id: string; colour: string; line: readonly LonLat[] }[] {
    return trails.map(([id, trail]) => ({ id, colour: colourOf(id), line: this.endOf(id, trail, colourOf).line ?? [] }));
  }

  private endOf(id: string, trail: Trail, colourOf: (id: string) => string): Mark {
    const points = trail.points.slice(Math.max(0, this.settledTo(trail) - trail.first));
    return { properties: { id, colour: colourOf(id) }, line: points.map(lonLat) };
  }

  private settledTo(trail: Trail): number {
    return this.pieces.get(trail)?.at(-1)?.to ?? trail.first;
  }

  /** Pieces of trails that are gone, and those whose last point is no longer kept. */
  private forgetOld(present: Set<Trail>): number[] {
    const removed: Piece[] = [];
    for (const [trail, pieces] of this.pieces) {
      const stays = (piece: Piece): boolean => present.has(trail) && piece.to > trail.first;
      removed.push(...pieces.filter((piece) => !stays(piece)));
      if (present.has(trail)) this.pieces.set(trail, pieces.filter(stays));
      else this.pieces.delete(trail);
    }
    return removed.map(({ feature }) => feature);
  }
}
