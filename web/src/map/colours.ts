import type { Level } from '../lib/status';

/** What the map is drawn with besides the colours by which vehicles are told apart; those of states are app.css's, too. */
export interface MapColours {
  ground: string;
  minor: string;
  major: string;
  /** Of lines of the grid and their labels. */
  label: string;
  panel: string;
  text: string;
  accent: string;
  levels: Record<Level, string>;
}

export const DARK: MapColours = {
  ground: '#0c1318',
  minor: '#18252e',
  major: '#273a47',
  label: '#7f97a6',
  panel: '#131c23',
  text: '#e7eef2',
  accent: '#5aaeff',
  levels: { ready: '#3ecf9b', active: '#5aaeff', warning: '#f5b946', critical: '#ff6b6b', lost: '#8c9aa3' },
};
export const LIGHT: MapColours = {
  ground: '#eef2f3',
  minor: '#e0e7ea',
  major: '#c9d5da',
  label: '#637987',
  panel: '#ffffff',
  text: '#15222b',
  accent: '#0b61c4',
  levels: { ready: '#0b7a55', active: '#0b61c4', warning: '#8f5300', critical: '#c01f2e', lost: '#5f6f79' },
};
