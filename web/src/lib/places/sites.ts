import type { VehicleFields } from '../wire/vehicle_fields';
import type { Position, SitePose } from '../protocol';

const METRES_PER_DEGREE = 111_319.49;

/** Where a site's frame begins; nothing for a site that this station does not know. */
export type AnchorOf = (site: string) => Position | undefined;

/** Of a place in the frame of a site: x east and y north of its anchor. */
export function siteToMap({ x_m, y_m, z_m }: SitePose, anchor: Position): Position {
  const metresPerDegreeEast = METRES_PER_DEGREE * Math.max(0.01, Math.cos((anchor.lat_deg * Math.PI) / 180));
  return {
    lat_deg: anchor.lat_deg + y_m / METRES_PER_DEGREE,
    lon_deg: anchor.lon_deg + x_m / metresPerDegreeEast,
    alt_m: anchor.alt_m + z_m,
  };
}

/** Clockwise from north, of an angle counterclockwise from east. */
export function headingOf(yaw_rad: number): number {
  const turn = 2 * Math.PI;
  return (((Math.PI / 2 - yaw_rad) % turn) + turn) % turn;
}

/** What moves in a site's frame alone has a place on the map, too, where its site is known. */
export function placedBySite(fields: VehicleFields, anchorOf: AnchorOf): Pick<VehicleFields, 'position' | 'heading_rad'> {
  const anchor = fields.site_pose && anchorOf(fields.site_pose.site);
  if (!fields.site_pose || !anchor) return {};
  const position = siteToMap(fields.site_pose, anchor);
  // Who says that it is a million kilometres from its site is nowhere.
  if (Math.abs(position.lat_deg) > 90 || Math.abs(position.lon_deg) > 180) return {};
  return { position, heading_rad: headingOf(fields.site_pose.yaw_rad) };
}
