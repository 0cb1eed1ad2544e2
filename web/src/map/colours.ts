/** What the map is drawn with besides the colours of vehicles. */
export interface MapColours {
  ground: string;
  minor: string;
  major: string;
  label: string;
}

export const DARK: MapColours = { ground: '#0c1318', minor: '#18252e', major: '#273a47', label: '#7f97a6' };
export const LIGHT: MapColours = { ground: '#eef2f3', minor: '#e0e7ea', major: '#c9d5da', label: '#637987' };
