import type { FeatureCollection } from 'geojson';
import type { ServerMessage } from '../lib/protocol';
import type { Receiver, Session } from './session.svelte';
import { readSetting, writeSetting } from './settings.svelte';

const KEY = 'lapwing.base-map';
const KINDS: readonly unknown[] = ['tiles', 'vector_tiles', 'drawing'];

/** What may lie under everything. */
export interface BaseMap {
  id: string;
  name: string;
  attribution: string;
  kind: 'tiles' | 'vector_tiles' | 'drawing';
  /** Of the station where it begins with a slash. */
  url: string;
  /** What the layers of vector tiles are called. */
  vector_layers?: readonly string[];
  min_zoom?: number;
  max_zoom?: number;
  bounds_deg?: [number, number, number, number];
}

/** The base maps that the station offers, which of them is shown, and why it is not. */
export class BaseMapsStore implements Receiver {
  readonly feeds = [];
  offered = $state.raw<readonly BaseMap[]>([]);
  /** The drawing of the current one, once it is there. */
  drawing = $state.raw<FeatureCollection | undefined>();
  /** Why it cannot be seen. */
  failure = $state('');
  private chosen = $state(readSetting(KEY));

  constructor(private readonly session: Session) {}

  /** The one that was chosen, else the first; nothing for a plain ground. */
  get current(): BaseMap | undefined {
    if (this.chosen === 'none') return undefined;
    return this.offered.find(({ id }) => id === this.chosen) ?? this.offered[0];
  }

  choose(id: string): void {
    this.chosen = id;
    writeSetting(KEY, id);
    this.failure = '';
    void this.load();
  }

  failed(reason: string): void {
    const name = this.current?.name ?? 'The base map';
    this.failure = `${name} cannot be shown: ${reason}`;
  }

  received(message: ServerMessage): void {
    if (message.type === 'hello') void this.ask();
  }

  private async ask(): Promise<void> {
    const answer = await this.session.ask('/api/v1/basemaps');
    if (!answer?.ok) return; // an older station has none
    const body = (await answer.json().catch(() => ({}))) as { basemaps?: unknown };
    this.offered = Array.isArray(body.basemaps) ? body.basemaps.filter(isBaseMap) : [];
    await this.load();
  }

  private async load(): Promise<void> {
    const { current } = this;
    this.drawing = undefined;
    if (current?.kind !== 'drawing') return;
    const answer = await this.session.ask(current.url);
    const body: unknown = await answer?.json().catch(() => undefined);
    if (current !== this.current) return;
    if (answer?.ok && isCollection(body)) this.drawing = body;
    else this.failed(answer ? `the station answers ${answer.status}` : 'the station does not answer');
  }
}

function isBaseMap(value: unknown): value is BaseMap {
  const { id, name, attribution, kind, url, vector_layers: layers = [] } = (value ?? {}) as Partial<BaseMap>;
  const isNamed = [id, name, attribution, url].every((text) => typeof text === 'string') && KINDS.includes(kind);
  // Vector tiles that do not say what is in them cannot be drawn.
  const isDrawn = kind !== 'vector_tiles' || (Array.isArray(layers) && layers.length > 0 && layers.every((one) => typeof one === 'string'));
  return isNamed && isDrawn;
}

function isCollection(value: unknown): value is FeatureCollection {
  const { type, features } = (value ?? {}) as Partial<FeatureCollection>;
  return type === 'FeatureCollection' && Array.isArray(features);
}
