import { COORDINATE_FORMS, type CoordinateForm } from '../lib/places/coordinates';
import type { Grouping, Order } from '../lib/attention';

export type Theme = 'system' | 'light' | 'dark';

const THEME = 'lapwing.theme';
const TILES = 'lapwing.tiles';
const SOUND = 'lapwing.sound';
const VOICE = 'lapwing.voice';
const COORDINATES = 'lapwing.coordinates';
const GROUPING = 'lapwing.fleet.grouping';
const ORDER = 'lapwing.fleet.order';
const DOCK = 'lapwing.dock';
const DOCK_HEIGHT = 'lapwing.dock.height';

/** What this browser's user prefers, kept in it. */
export class Settings {
  theme = $state<Theme>(readSetting(THEME) === 'light' ? 'light' : readSetting(THEME) === 'dark' ? 'dark' : 'system');
  /** An XYZ tile address with {z}, {x} and {y}; empty: the plain grid alone. */
  tiles = $state(readSetting(TILES));
  /** Whether alarms sound. */
  sound = $state(readSetting(SOUND) === 'on');
  /** Whether they are spoken. */
  voice = $state(readSetting(VOICE) === 'on');
  /** How places on the map are told. */
  coordinates = $state<CoordinateForm>(oneOf(COORDINATE_FORMS, readSetting(COORDINATES), 'WGS84'));
  grouping = $state<Grouping>(oneOf(['none', 'kind', 'state'] as const, readSetting(GROUPING), 'none'));
  order = $state<Order>(oneOf(['attention', 'id'] as const, readSetting(ORDER), 'attention'));
  /** The tab of the dock that was open last, or "closed"; empty for who has never chosen. */
  dock = $state(readSetting(DOCK));
  /** In px, of the dock when it is open; 0 for who has never chosen. */
  dockHeight = $state(Math.max(0, Number(readSetting(DOCK_HEIGHT)) || 0));
  private systemIsDark = $state(matchMedia('(prefers-color-scheme: dark)').matches);

  constructor() {
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', (event) => (this.systemIsDark = event.matches));
  }

  get isDark(): boolean {
    return this.theme === 'system' ? this.systemIsDark : this.theme === 'dark';
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    writeSetting(THEME, theme === 'system' ? '' : theme);
  }

  setSound(isOn: boolean): void {
    this.sound = isOn;
    writeSetting(SOUND, isOn ? 'on' : '');
  }

  setVoice(isOn: boolean): void {
    this.voice = isOn;
    writeSetting(VOICE, isOn ? 'on' : '');
  }

  setCoordinates(form: CoordinateForm): void {
    this.coordinates = form;
    writeSetting(COORDINATES, form === 'WGS84' ? '' : form);
  }

  setGrouping(grouping: Grouping): void {
    this.grouping = grouping;
    writeSetting(GROUPING, grouping === 'none' ? '' : grouping);
  }

  setOrder(order: Order): void {
    this.order = order;
    writeSetting(ORDER, order === 'attention' ? '' : order);
  }

  setDock(tab: string): void {
    this.dock = tab;
    writeSetting(DOCK, tab);
  }

  setDockHeight(height: number): void {
    this.dockHeight = height;
    writeSetting(DOCK_HEIGHT, String(Math.round(height)));
  }

  setTiles(address: string): void {
    this.tiles = address;
    writeSetting(TILES, address);
  }
}

function oneOf<T extends string>(known: readonly T[], told: string, usual: T): T {
  return known.find((one) => one === told) ?? usual;
}

export function readSetting(key: string): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return ''; // storage may be forbidden; the app works without
  }
}

export function writeSetting(key: string, value: string): void {
  try {
    if (value) localStorage.setItem(key, value);
    else localStorage.removeItem(key);
  } catch {
    // the setting lasts as long as the page
  }
}
