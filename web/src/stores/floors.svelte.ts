import type { Frame } from '../connection/frame';
import type { Position } from '../lib/protocol';
import type { MapFeature } from '../layers/found/map_features';
import type { Followed, FeedsStore } from './feeds.svelte';

export interface Floor {
  id: string;
  name: string;
  up_m: number;
}

export interface MapSite {
  id: string;
  anchor: Position;
  /** From the lowest to the highest. */
  floors: readonly Floor[];
}

type Sites = ReadonlyMap<string, MapSite>;

/** The sites of the map, and which floor of each is shown. */
export class FloorsStore {
  private readonly told: Followed<Sites>;
  private chosen = $state.raw<ReadonlyMap<string, string>>(new Map());

  constructor(feeds: FeedsStore) {
    this.told = feeds.follow<Sites>('map.sites', new Map(), (sites, { content }) => sitesOf(content) ?? sites);
  }

  get sites(): Sites {
    return this.told.content;
  }

  /** The one that was chosen; else the one on the ground. */
  floorOf(site: string): string {
    const { floors = [] } = this.sites.get(site) ?? {};
    const chosen = this.chosen.get(site);
    if (chosen !== undefined && floors.some(({ id }) => id === chosen)) return chosen;
    return [...floors].sort((a, b) => Math.abs(a.up_m) - Math.abs(b.up_m))[0]?.id ?? '';
  }

  choose(site: string, floor: string): void {
    this.chosen = new Map(this.chosen).set(site, floor);
  }

  /** What names no floor lies on the ground of its site, whichever floor is looked at. */
  readonly isShown = ({ properties: { site, floor } }: Pick<MapFeature, 'properties'>): boolean =>
    typeof floor !== 'string' || floor === '' || typeof site !== 'string' || floor === this.floorOf(site);
}

function sitesOf(content: Frame['content']): Sites | undefined {
  if (content instanceof Uint8Array || content.type !== 'sites' || !Array.isArray(content.sites)) return undefined;
  return new Map(content.sites.flatMap((one: unknown) => (isSite(one) ? [[one.id, one] as const] : [])));
}

function isSite(value: unknown): value is MapSite {
  const { id, anchor, floors } = (value ?? {}) as Partial<MapSite>;
  return typeof id === 'string' && typeof anchor?.lat_deg === 'number' && typeof anchor.lon_deg === 'number' && Array.isArray(floors);
}
