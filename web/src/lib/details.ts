import { ageOf, type Vehicle } from './fleet';
import { heading, linkText, metres, percent, span, spanAbout, speed } from './format';
import type { Battery, Component, LinkQuality, VehicleFields } from './protocol';
import { batteryLevel, isOld, USUAL_LIMITS, type BatteryLimits } from './status';

/** One line about a vehicle. `age` is set only when it is old enough to be told. */
export interface Detail {
  label: string;
  value: string;
  level?: 'warning' | 'critical';
  age?: number;
}

export interface DetailGroup {
  title: string;
  rows: Detail[];
}

/** Younger than this, a value is as good as present: the slowest of them comes every two seconds. */
export const OLD_S = 10;
const TEXTS_SHOWN = 5;
const DEGREES = 180 / Math.PI;

/** What is known of a vehicle beyond its line in the table; groups without anything to tell are left out. */
export function detailsOf(vehicle: Vehicle, now: number, limits: BatteryLimits = USUAL_LIMITS): DetailGroup[] {
  const { fields } = vehicle;
  // Of a silent vehicle each value is the last that is known, however young.
  const oldFrom = isOld(vehicle) ? 0 : OLD_S;
  const row = (label: string, key: string, value: string | undefined, level?: Detail['level']): Detail[] => {
    if (value === undefined) return [];
    const age = ageOf(vehicle, key, now);
    return [{ label, value, ...(level && { level }), ...(age !== undefined && age >= oldFrom && { age }) }];
  };
  const groups: DetailGroup[] = [
    {
      title: 'Cannot arm',
      rows: (fields.arming_reasons ?? []).flatMap((reason) => row('', 'arming_reasons', withoutPrefix(reason), 'warning')),
    },
    { title: 'Battery', rows: batteryRows(fields, row, limits) },
    {
      title: 'Position',
      rows: [
        ...row(
          'GPS',
          'gps',
          gpsText(fields.gps),
          (fields.gps?.fix ?? '3D') === 'no fix' || fields.gps?.fix === 'no GPS' ? 'warning' : undefined,
        ),
        ...row('Site', 'site_pose', siteText(fields.site_pose)),
        ...row('Estimate', 'estimator', estimatorText(fields.estimator), estimatorLevel(fields.estimator)),
        ...row('Sick', 'unhealthy', fields.unhealthy?.length ? fields.unhealthy.join(', ') : undefined, 'warning'),
      ],
    },
    {
      title: 'Flight',
      rows: [
        ...row('Airspeed', 'hud', fields.hud && speed(fields.hud.airspeed_m_s)),
        ...row('Climb', 'hud', fields.hud && speed(fields.hud.climb_m_s)),
        ...row('Throttle', 'hud', fields.hud && percent(fields.hud.throttle)),
        ...row('Wind', 'wind', fields.wind && `${speed(fields.wind.speed_m_s)} from ${heading(fields.wind.from_rad)}`),
        ...row('Fence', 'fence', fields.fence?.breached ? `breached: ${fields.fence.type ?? 'fence'}` : undefined, 'critical'),
      ],
    },
    {
      title: 'Mission',
      rows: [
        ...row('State', 'mission', fields.mission?.total ? fields.mission.state : undefined),
        ...row('To go', 'waypoint_distance_m', fields.mission?.state === 'active' ? metres(fields.waypoint_distance_m) : undefined),
      ],
    },
    {
      title: 'Links',
      rows: [
        ...linkRows(fields.links ?? []),
        ...row('Radio', 'radio', radioText(fields.radio), (fields.radio?.buffer_free ?? 1) < 0.3 ? 'warning' : undefined),
        ...row('Remote', 'remote_control', remoteText(fields.remote_control), fields.remote_control?.lost ? 'warning' : undefined),
      ],
    },
    {
      title: 'Aboard',
      rows: [
        ...row('Carrier', 'carrier', carrierText(fields.carrier), carrierLevel(fields.carrier)),
        ...row('Gimbal', 'gimbal', gimbalText(fields.gimbal)),
        ...row('Pictures', 'pictures', picturesText(fields.pictures)),
        ...(fields.components ?? []).flatMap((part) =>
          row(capital(part.kind), `component_${part.id}`, componentText(part), componentLevel(part)),
        ),
      ],
    },
    {
      title: 'Said',
      rows: (fields.texts ?? [])
        .slice(-TEXTS_SHOWN)
        .reverse()
        .map(({ severity, text, component }) => ({
          label: component === undefined ? '' : String(component),
          value: text,
          ...(severity <= 3 ? { level: 'critical' as const } : severity === 4 ? { level: 'warning' as const } : {}),
        })),
    },
  ];
  return groups.filter(({ rows }) => rows.length > 0);
}

type Row = (label: string, key: string, value: string | undefined, level?: Detail['level']) => Detail[];

/** Where there is but one, its name says nothing that matters here. */
function linkRows(links: LinkQuality[]): Detail[] {
  const text = (link: LinkQuality): string => (links.length > 1 ? `${link.name.split(' from ')[0]}: ${linkText(link)}` : linkText(link));
  return links.map((link) => ({
    label: link.used ? 'In use' : 'Spare',
    value: text(link),
    ...(!link.alive && { level: 'warning' as const }),
  }));
}

function batteryRows({ battery, further_batteries }: VehicleFields, row: Row, limits: BatteryLimits): Detail[] {
  const rows = battery
    ? [
        ...row('Left', 'battery', timeLeft(battery)),
        ...row('In flight', 'battery', inFlight(battery)),
        ...row('Power', 'battery', powerText(battery)),
      ]
    : [];
  for (const other of further_batteries ?? []) {
    const text = [percent(other.remaining), timeLeft(other), powerText(other)].filter(Boolean).join(', ');
    const level = batteryLevel(other.remaining, limits);
    rows.push(...row(`Battery ${(other.id ?? 0) + 1}`, 'further_batteries', text, level === 'ready' ? undefined : level));
  }
  return rows;
}

/** How long the charge lasts at what the vehicle does now. */
export function timeLeft({ time_left_s, time_left_is_estimate, time_left_error_s = 0 }: Battery): string | undefined {
  if (time_left_s === undefined) return undefined;
  return time_left_is_estimate ? spanAbout(time_left_s, time_left_error_s) : span(time_left_s);
}

/** The same in flight, told only while it does not fly: by the flight before. */
function inFlight({ time_left_s, in_flight_s, in_flight_error_s = 0 }: Battery): string | undefined {
  if (time_left_s !== undefined || in_flight_s === undefined) return undefined;
  return `${spanAbout(in_flight_s, in_flight_error_s)}, by its last flight`;
}

function powerText({ voltage_v, current_a, consumed_ah }: Battery): string | undefined {
  const parts = [
    voltage_v !== undefined ? `${voltage_v.toFixed(1)} V` : '',
    current_a !== undefined ? `${current_a.toFixed(1)} A` : '',
    consumed_ah !== undefined ? `${consumed_ah.toFixed(2)} Ah used` : '',
  ].filter(Boolean);
  return parts.length > 0 ? parts.join(', ') : undefined;
}

function gpsText(gps: VehicleFields['gps']): string | undefined {
  if (!gps) return undefined;
  const parts = [
    gps.fix,
    gps.satellites !== undefined ? `${gps.satellites} satellites` : '',
    gps.hdop !== undefined ? `HDOP ${gps.hdop.toFixed(1)}` : '',
  ];
  return parts.filter(Boolean).join(', ');
}

function siteText(pose: VehicleFields['site_pose']): string | undefined {
  if (!pose) return undefined;
  const where = pose.floor === undefined ? pose.site : `${pose.site}, floor ${pose.floor}`;
  return `${where}: ${pose.x_m.toFixed(1)} east, ${pose.y_m.toFixed(1)} north`;
}

/** What it does, where that is not what it was asked to. */
function carrierText(carrier: VehicleFields['carrier']): string | undefined {
  if (!carrier) return undefined;
  if (carrier.killed) return 'killed';
  if (carrier.avoids_obstacle) return 'backs away from an obstacle';
  const asked = speed(carrier.asked_speed_m_s);
  return carrier.completed ? `goes ${asked}` : `asked for ${asked}`;
}

function carrierLevel(carrier: VehicleFields['carrier']): Detail['level'] {
  if (carrier?.killed) return 'critical';
  return carrier?.avoids_obstacle ? 'warning' : undefined;
}

/** The worst of its innovations, by the name of what disagrees. */
function worst(estimator: NonNullable<VehicleFields['estimator']>): [string, number] {
  const named: [string, number][] = [
    ['velocity', estimator.velocity ?? 0],
    ['horizontal position', estimator.position_horizontal ?? 0],
    ['height', estimator.position_vertical ?? 0],
    ['compass', estimator.compass ?? 0],
  ];
  return named.reduce((a, b) => (b[1] > a[1] ? b : a));
}

function estimatorText(estimator: VehicleFields['estimator']): string | undefined {
  if (!estimator) return undefined;
  const [name, value] = worst(estimator);
  return value < 0.5 ? 'good' : `${name} ${value.toFixed(1)}`;
}

function estimatorLevel(estimator: VehicleFields['estimator']): Detail['level'] {
  const value = estimator ? worst(estimator)[1] : 0;
  return value >= 1 ? 'critical' : value >= 0.5 ? 'warning' : undefined;
}

function radioText(radio: VehicleFields['radio']): string | undefined {
  if (!radio) return undefined;
  return `signal ${radio.rssi ?? '–'} / ${radio.remote_rssi ?? '–'}, noise ${radio.noise ?? '–'} / ${radio.remote_noise ?? '–'}, buffer ${percent(radio.buffer_free)} free`;
}

function remoteText(remote: VehicleFields['remote_control']): string | undefined {
  if (!remote) return undefined;
  if (remote.lost) return remote.channels === 0 ? 'none' : 'lost';
  return remote.rssi === undefined ? `${remote.channels} channels` : `${remote.channels} channels, signal ${percent(remote.rssi)}`;
}

function gimbalText(gimbal: VehicleFields['gimbal']): string | undefined {
  if (!gimbal) return undefined;
  const pitch = Math.round(gimbal.pitch_rad * DEGREES);
  const tilt = pitch === 0 ? 'level' : `${Math.abs(pitch)}° ${pitch < 0 ? 'down' : 'up'}`;
  return gimbal.yaw_is_from_north ? `${tilt}, towards ${heading(gimbal.yaw_rad)}` : `${tilt}, ${heading(gimbal.yaw_rad)} of the nose`;
}

function picturesText(pictures: VehicleFields['pictures']): string | undefined {
  if (!pictures) return undefined;
  return pictures.lost > 0 ? `${pictures.taken}, of ${pictures.lost} the place is not known` : String(pictures.taken);
}

function componentText({ model, state, id }: Component): string {
  return [model || `number ${id}`, state].filter(Boolean).join(', ');
}

function componentLevel({ state }: Component): Detail['level'] {
  return state === 'critical' || state === 'emergency' ? 'critical' : undefined;
}

function withoutPrefix(reason: string): string {
  return reason.replace(/^(PreArm|Arm|Preflight Fail): /, '');
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
