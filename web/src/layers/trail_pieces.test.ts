import type { Feature, LineString } from 'geojson';
import type { GeoJSONSourceDiff } from 'maplibre-gl';
import { describe, expect, it } from 'vitest';
import { Trails } from '../lib/places/trails';
import { TrailPieces } from './trail_pieces';

const colour = (): string => 'red';

/** A map as far as trails go: what its two sources hold. */
class Sources {
  readonly settled = new Map<number, Feature>();
  ends: ReturnType<TrailPieces['ends']> = [];
  /** Points that were sent to it. */
  sent = 0;

  apply({ removeAll, remove = [], add = [] }: GeoJSONSourceDiff): void {
    if (removeAll) this.settled.clear();
    for (const id of remove) expect(this.settled.delete(id as number), `${id} was there`).toBe(true);
    for (const feature of add) this.settled.set(feature.id as number, feature);
    this.sent += add.reduce((sum, feature) => sum + pointsOf(feature).length, 0);
  }

  show(ends: ReturnType<TrailPieces['ends']>): void {
    this.ends = ends.filter(({ line }) => line.length > 1);
    this.sent += ends.reduce((sum, { line }) => sum + line.length, 0);
  }

  /** The whole trail of a vehicle, each point once; throws where pieces do not meet. */
  trailOf(id: string): number[] {
    const settled = [...this.settled.values()].filter(({ properties }) => properties?.id === id).map(pointsOf);
    const mine = [...settled, ...this.ends.filter((end) => end.id === id).map(({ line }) => line.map(([, lat]) => lat))];
    return mine.reduce((whole, piece) => {
      if (whole.length === 0) return piece;
      expect(piece[0]).toBe(whole.at(-1));
      return [...whole, ...piece.slice(1)];
    }, []);
  }
}

const pointsOf = (feature: Feature): number[] => (feature.geometry as LineString).coordinates.map(([, lat]) => lat!);

function fly(trails: Trails, ids: string[], from: number, to: number, each: () => void): void {
  for (let i = from; i < to; ++i) {
    trails.grow(ids.map((id) => ({ id, fields: { position: { lat_deg: i / 1000, lon_deg: 0, alt_m: 0 } }, heardAt: {} })));
    each();
  }
}

describe('the pieces of trails', () => {
  const draw = (pieces: TrailPieces, sources: Sources, trails: Trails): void => {
    const all = [...trails.entries()];
    if (pieces.wantSettling(all)) sources.apply(pieces.settle(all, colour, false));
    sources.show(pieces.ends(all, colour));
  };

  it('are the whole trail together, however long it grows', () => {
    const [trails, pieces, sources] = [new Trails(), new TrailPieces(), new Sources()];
    fly(trails, ['1', '2'], 0, 3000, () => draw(pieces, sources, trails));
    for (const id of ['1', '2']) {
      const shown = sources.trailOf(id);
      const kept = trails.get(id)!.points.map(({ lat_deg }) => lat_deg);
      expect(shown.slice(-kept.length)).toEqual(kept);
      expect(shown.length - kept.length, 'of what is no longer kept, a piece at most').toBeLessThan(1000);
    }
  });

  it('are sent once: a hundred vehicles cost a tick some thousand points, not all of them', () => {
    const [trails, pieces, sources] = [new Trails(), new TrailPieces(), new Sources()];
    const ids = Array.from({ length: 100 }, (_, index) => String(index));
    fly(trails, ids, 0, 1500, () => {});
    draw(pieces, sources, trails);
    sources.sent = 0;
    fly(trails, ids, 1500, 1580, () => draw(pieces, sources, trails));
    expect(sources.sent / 80).toBeLessThan(4500);
  });

  it('go with their vehicle', () => {
    const [trails, pieces, sources] = [new Trails(), new TrailPieces(), new Sources()];
    fly(trails, ['1', '2'], 0, 1500, () => draw(pieces, sources, trails));
    fly(trails, ['2'], 1500, 1501, () => draw(pieces, sources, trails));
    expect(sources.trailOf('1')).toEqual([]);
    expect(sources.trailOf('2').length).toBeGreaterThan(1000);
  });

  it('can be made anew, one of each trail', () => {
    const [trails, pieces, sources] = [new Trails(), new TrailPieces(), new Sources()];
    fly(trails, ['1'], 0, 1500, () => draw(pieces, sources, trails));
    sources.apply(pieces.settle([...trails.entries()], () => 'blue', true));
    expect(sources.settled.size).toBe(1);
    expect([...sources.settled.values()][0]!.properties!.colour).toBe('blue');
    expect(pieces.ends([...trails.entries()], colour).filter(({ line }) => line.length > 1)).toEqual([]);
  });
});
