import { forward } from 'mgrs';
import { fromLatLon } from 'utm';
import { latitude, longitude } from '../format';

/** How places are told, by choice. */
export type CoordinateForm = 'WGS84' | 'UTM' | 'MGRS';
export const COORDINATE_FORMS: readonly CoordinateForm[] = ['WGS84', 'UTM', 'MGRS'];

interface Place {
  lat_deg: number;
  lon_deg: number;
}

/** UTM and MGRS end before the poles. */
const SOUTH_END_DEG = -80;
const NORTH_END_DEG = 84;

/** "47.39770° N, 8.54560° E", "32T 465713 E 5249472 N" or "32T MT 65713 49472"; near the poles WGS84, whatever was chosen. */
export function coordinatesText({ lat_deg, lon_deg }: Place, form: CoordinateForm): string {
  const lon = ((((lon_deg + 180) % 360) + 360) % 360) - 180; // the map goes on beyond its own edges
  if (form === 'WGS84' || lat_deg < SOUTH_END_DEG || lat_deg >= NORTH_END_DEG) return `${latitude(lat_deg)}, ${longitude(lon)}`;
  if (form === 'MGRS') return forward([lon, lat_deg]).replace(/^(\d+[A-Z])([A-Z]{2})(\d{5})(\d{5})$/, '$1 $2 $3 $4');
  const { easting, northing, zoneNum, zoneLetter } = fromLatLon(lat_deg, lon);
  return `${zoneNum}${zoneLetter} ${Math.floor(easting)} E ${Math.floor(northing)} N`;
}
