export type Theme = 'system' | 'light' | 'dark';

const THEME = 'lapwing.theme';
const TILES = 'lapwing.tiles';
const SOUND = 'lapwing.sound';
const VOICE = 'lapwing.voice';

/** What this browser's user prefers, kept in it. */
export class Settings {
  theme = $state<Theme>(read(THEME) === 'light' ? 'light' : read(THEME) === 'dark' ? 'dark' : 'system');
  /** An XYZ tile address with {z}, {x} and {y}; empty: the plain grid alone. */
  tiles = $state(read(TILES));
  /** Whether alarms sound. */
  sound = $state(read(SOUND) === 'on');
  /** Whether they are spoken. */
  voice = $state(read(VOICE) === 'on');
  private systemIsDark = $state(matchMedia('(prefers-color-scheme: dark)').matches);

  constructor() {
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', (event) => (this.systemIsDark = event.matches));
  }

  get isDark(): boolean {
    return this.theme === 'system' ? this.systemIsDark : this.theme === 'dark';
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    write(THEME, theme === 'system' ? '' : theme);
  }

  setSound(isOn: boolean): void {
    this.sound = isOn;
    write(SOUND, isOn ? 'on' : '');
  }

  setVoice(isOn: boolean): void {
    this.voice = isOn;
    write(VOICE, isOn ? 'on' : '');
  }

  setTiles(address: string): void {
    this.tiles = address;
    write(TILES, address);
  }
}

function read(key: string): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return ''; // storage may be forbidden; the app works without
  }
}

function write(key: string, value: string): void {
  try {
    if (value) localStorage.setItem(key, value);
    else localStorage.removeItem(key);
  } catch {
    // the setting lasts as long as the page
  }
}
