import { destinationsOf } from '../commands';
import { groundSpeed, type Vehicle } from '../fleet';
import { metres, span } from '../format';
import type { Command, Position } from '../protocol';

/** Where a vehicle is bound for now, as far as it or a command tells. */
export interface Target {
  place: Position;
  /** Above its home, where that is known. */
  height_m: number | undefined;
  distance_m: number;
  time_s: number | undefined;
}

const METRES_PER_DEGREE = 111_319.49;
/** Slower than this it does not go there. */
const UNDER_WAY_M_S = 0.5;
/** So well must a place of the plan match the distance that the vehicle tells, in m and as a share of it. */
const SLACK_M = 6;
const SLACK = 0.08;

/** East and north of `from`, in m. */
function offset(from: Position, to: Position): [number, number] {
  const east = (to.lon_deg - from.lon_deg) * METRES_PER_DEGREE * Math.cos((from.lat_deg * Math.PI) / 180);
  return [east, (to.lat_deg - from.lat_deg) * METRES_PER_DEGREE];
}

export function distanceBetween(from: Position, to: Position): number {
  return Math.hypot(...offset(from, to));
}

/** Clockwise from north. */
export function bearingTo(from: Position, to: Position): number {
  const [east, north] = offset(from, to);
  return Math.atan2(east, north);
}

export function homeDistance({ fields: { position, home } }: Vehicle): number | undefined {
  return position && home && distanceBetween(position, home);
}

/** Where an operator's command sends it, else the place of its mission that it says to be so far from. */
export function targetOf(vehicle: Vehicle, commands: readonly Command[], path: readonly Position[] = []): Target | undefined {
  const { position, home } = vehicle.fields;
  if (!position) return undefined;
  const sent = destinationsOf(commands).find((one) => one.vehicle === vehicle.id)?.place;
  const place = sent ?? placeOfMission(vehicle, position, path);
  if (!place) return undefined;
  const distance_m = distanceBetween(position, place);
  const speed = groundSpeed(vehicle) ?? 0;
  return {
    place,
    height_m: home && place.alt_m !== 0 ? place.alt_m - home.alt_m : undefined,
    distance_m,
    time_s: speed > UNDER_WAY_M_S ? distance_m / speed : undefined,
  };
}

/** A vehicle tells how far it has to go, not to where: of the places at that distance it is the one that it flies to. */
function placeOfMission({ fields }: Vehicle, position: Position, path: readonly Position[]): Position | undefined {
  const { mission, waypoint_distance_m: told, velocity_m_s: velocity } = fields;
  if (mission?.state !== 'active' || told === undefined || told <= 0) return undefined;
  const course = velocity && Math.atan2(velocity.east, velocity.north);
  const offCourse = (place: Position): number =>
    course === undefined
      ? 0
      : Math.abs(Math.atan2(Math.sin(bearingTo(position, place) - course), Math.cos(bearingTo(position, place) - course)));
  return path
    .filter((place) => Math.abs(distanceBetween(position, place) - told) < Math.max(SLACK_M, SLACK * told))
    .sort((a, b) => offCourse(a) - offCourse(b))[0];
}

/** "at 20 m, 120 m to go, 15 s". */
export function targetText({ height_m, distance_m, time_s }: Target): string {
  return [height_m !== undefined && `at ${metres(height_m)}`, `${metres(distance_m)} to go`, time_s !== undefined && span(time_s)]
    .filter(Boolean)
    .join(', ');
}
