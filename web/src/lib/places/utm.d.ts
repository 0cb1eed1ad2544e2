declare module 'utm' {
  export function fromLatLon(
    latitude: number,
    longitude: number,
  ): { easting: number; northing: number; zoneNum: number; zoneLetter: string };
}
