import { readSetting, writeSetting } from './settings.svelte';

const KEY = 'lapwing.layers';

/** How an operator wants a layer of the map. */
export interface LayerLook {
  visible: boolean;
  /** 0 to 1, of what the layer has by itself. */
  opacity: number;
}

const USUAL: LayerLook = { visible: true, opacity: 1 };

/** Which layers the map shows, how clearly, and in what order, kept in this browser. */
export class MapLayersStore {
  private looks = $state.raw<Readonly<Record<string, LayerLook>>>({});
  /** Ids of layers that were moved, the lowest first; those that it lacks stay at their place. */
  private moved = $state.raw<readonly string[]>([]);

  constructor() {
    try {
      const kept = JSON.parse(readSetting(KEY) || '{}') as { looks?: unknown; order?: unknown };
      this.looks = Object.fromEntries(Object.entries(kept.looks ?? {}).flatMap(([id, look]) => (isLook(look) ? [[id, look]] : [])));
      this.moved = Array.isArray(kept.order) ? kept.order.filter((id) => typeof id === 'string') : [];
    } catch {
      // what an older version has kept, or somebody has spoilt: as at first
    }
  }

  lookOf(id: string): LayerLook {
    return this.looks[id] ?? USUAL;
  }

  setVisible(id: string, visible: boolean): void {
    this.change(id, { visible });
  }

  setOpacity(id: string, opacity: number): void {
    this.change(id, { opacity: Math.min(1, Math.max(0, opacity)) });
  }

  /** Those layers, the lowest first, as the operator has ordered them. */
  ordered<T extends { id: string }>(layers: readonly T[]): T[] {
    if (this.moved.length === 0) return [...layers];
    const known = this.moved.flatMap((id) => layers.find((layer) => layer.id === id) ?? []);
    const places = layers.map((layer) => (this.moved.includes(layer.id) ? undefined : layer));
    return places.map((layer) => layer ?? known.shift()!);
  }

  /** Up is towards the viewer. */
  move<T extends { id: string }>(layers: readonly T[], id: string, up: boolean): void {
    const ids = this.ordered(layers).map((layer) => layer.id);
    const at = ids.indexOf(id);
    const to = at + (up ? 1 : -1);
    if (at < 0 || to < 0 || to >= ids.length) return;
    [ids[at], ids[to]] = [ids[to]!, ids[at]!];
    this.moved = ids;
    this.keep();
  }

  reset(): void {
    this.looks = {};
    this.moved = [];
    this.keep();
  }

  private change(id: string, look: Partial<LayerLook>): void {
    this.looks = { ...this.looks, [id]: { ...this.lookOf(id), ...look } };
    this.keep();
  }

  private keep(): void {
    const isUsual = Object.keys(this.looks).length === 0 && this.moved.length === 0;
    writeSetting(KEY, isUsual ? '' : JSON.stringify({ looks: this.looks, order: this.moved }));
  }
}

function isLook(value: unknown): value is LayerLook {
  const { visible, opacity } = (value ?? {}) as Partial<LayerLook>;
  return typeof visible === 'boolean' && typeof opacity === 'number' && opacity >= 0 && opacity <= 1;
}
