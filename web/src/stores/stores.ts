import { getContext, setContext } from 'svelte';
import type { Socket } from '../connection/connection';
import { BrowserVoices, type Voices } from '../lib/announcer';
import { rememberToken, socketUrl, takeToken } from '../connection/token';
import { AlarmsStore } from './alarms.svelte';
import { BaseMapsStore } from './base_maps.svelte';
import { ChangesStore } from './changes.svelte';
import { ControlStore } from './control.svelte';
import { ExportsStore } from './exports.svelte';
import { FeedsStore } from './feeds.svelte';
import { FloorsStore } from './floors.svelte';
import { FleetStore } from './fleet.svelte';
import { HealthStore } from './health.svelte';
import { HistoryStore } from './history.svelte';
import { LayersStore } from './layers.svelte';
import { LogStore } from './log.svelte';
import { MapLayersStore } from './map_layers.svelte';
import { PlacingStore } from './placing.svelte';
import { ScriptsStore } from './scripts.svelte';
import { Session, type Network } from './session.svelte';
import { Settings } from './settings.svelte';
import { SurveyStore } from './survey.svelte';

/** The station as the app sees it, each part of it in a store that alone writes it. */
export interface Stores {
  session: Session;
  fleet: FleetStore;
  layers: LayersStore;
  history: HistoryStore;
  mapLayers: MapLayersStore;
  feeds: FeedsStore;
  changes: ChangesStore;
  floors: FloorsStore;
  baseMaps: BaseMapsStore;
  exports: ExportsStore;
  placing: PlacingStore;
  scripts: ScriptsStore;
  control: ControlStore;
  log: LogStore;
  alarms: AlarmsStore;
  health: HealthStore;
  survey: SurveyStore;
  settings: Settings;
}

/** As components have them: to read, and to ask for something by calling a method. */
export type StoresToRead = { readonly [Name in keyof Stores]: Readonly<Stores[Name]> };

const KEY = 'stores';

export function createStores(network: Network, voices: Voices): Stores {
  const settings = new Settings();
  const session = new Session(network);
  const fleet = new FleetStore(session);
  const layers = new LayersStore(session, fleet);
  const feeds = new FeedsStore(session);
  const floors = new FloorsStore(feeds);
  const changes = new ChangesStore();
  const baseMaps = new BaseMapsStore(session);
  const exports = new ExportsStore(session);
  const placing = new PlacingStore(session);
  const history = new HistoryStore(fleet);
  const mapLayers = new MapLayersStore();
  const control = new ControlStore(session);
  const scripts = new ScriptsStore(session, control);
  const log = new LogStore(session);
  const alarms = new AlarmsStore(session, fleet, settings, voices);
  const health = new HealthStore(session);
  const survey = new SurveyStore(session);
  // Who reads another store hears after it.
  session.begin([fleet, layers, history, control, scripts, log, alarms, baseMaps]);
  return {
    session,
    fleet,
    layers,
    history,
    mapLayers,
    feeds,
    changes,
    floors,
    baseMaps,
    exports,
    placing,
    scripts,
    control,
    log,
    alarms,
    health,
    survey,
    settings,
  };
}

/** The stores of this page, over its own station. */
export function browserStores(): Stores {
  const stores = createStores(browserNetwork(), new BrowserVoices());
  // A browser sounds only once somebody has touched the page.
  for (const event of ['pointerdown', 'keydown'])
    addEventListener(event, () => stores.alarms.wakeSound(), { capture: true, passive: true });
  return stores;
}

function browserNetwork(): Network {
  return {
    open: (token) => new WebSocket(socketUrl(location, token)) as Socket,
    fetch: (address, init) => fetch(address, init),
    token: takeToken(location, sessionStorage, history),
    keepToken: (token) => rememberToken(token, sessionStorage),
  };
}

/** For `mount`, and for `render` of tests. */
export function contextOf(stores: Stores): Map<string, Stores> {
  return new Map([[KEY, stores]]);
}

/** To the components below. */
export function provide(stores: Stores): void {
  setContext(KEY, stores);
}

export function useStores(): StoresToRead {
  return getContext<StoresToRead>(KEY);
}
