// Made from src/station/fields/vehicle_fields.cpp by `station_fields write`. Do not change it here.

import { flag, list, number, object, orNull, text, word, type Shape } from './parsers';
import type {
  Attitude,
  Battery,
  Carrier,
  Component,
  Control,
  Estimator,
  Fence,
  Gimbal,
  Gps,
  Health,
  Hud,
  LinkQuality,
  MissionProgress,
  PictureCount,
  Position,
  Radio,
  RemoteControl,
  Said,
  SitePose,
  Velocity,
  Wind,
  VehicleFields,
} from './vehicle_fields';

const said = object<Said>(
  {
    severity: number(0, 7),
    text,
    component: number(0, 9007199254740991),
  },
  ['severity', 'text'],
);

const control = object<Control>(
  {
    commander: text,
    asked_for_by: text,
    granted_at_s: number(0, 1000000000),
  },
  ['commander'],
);

const linkQuality = object<LinkQuality>(
  {
    name: text,
    loss: number(0, 1),
    messages_per_s: number(0, 1000000),
    bytes_per_s: number(0, 1000000000),
    round_trip_s: number(0, 1000000000),
    alive: flag,
    used: flag,
  },
  ['name', 'messages_per_s', 'bytes_per_s', 'alive', 'used'],
);

const remoteControl = object<RemoteControl>(
  {
    lost: flag,
    channels: number(0, 9007199254740991),
    rssi: number(0, 1),
    pulses_us: list(orNull(number(0, 65535))),
  },
  ['lost', 'channels', 'pulses_us'],
);

const radio = object<Radio>(
  {
    rssi: number(-1000000, 1000000),
    remote_rssi: number(-1000000, 1000000),
    noise: number(-1000000, 1000000),
    remote_noise: number(-1000000, 1000000),
    buffer_free: number(0, 1),
    receive_errors: number(0, 9007199254740991),
  },
  ['receive_errors'],
);

const position = object<Position>(
  {
    lat_deg: number(-90, 90),
    lon_deg: number(-180, 180),
    alt_m: number(-10000000, 10000000),
  },
  ['lat_deg', 'lon_deg', 'alt_m'],
);

const sitePose = object<SitePose>(
  {
    site: text,
    floor: text,
    x_m: number(-10000000, 10000000),
    y_m: number(-10000000, 10000000),
    z_m: number(-10000000, 10000000),
    yaw_rad: number(-1000, 1000),
  },
  ['site', 'x_m', 'y_m', 'z_m', 'yaw_rad'],
);

const velocity = object<Velocity>(
  {
    north: number(-1000, 1000),
    east: number(-1000, 1000),
    down: number(-1000, 1000),
  },
  ['north', 'east', 'down'],
);

const attitude = object<Attitude>(
  {
    roll: number(-1000, 1000),
    pitch: number(-1000, 1000),
    yaw: number(-1000, 1000),
  },
  ['roll', 'pitch', 'yaw'],
);

const hud = object<Hud>(
  {
    airspeed_m_s: number(-1000, 1000),
    climb_m_s: number(-1000, 1000),
    throttle: number(-1, 2),
  },
  [],
);

const wind = object<Wind>(
  {
    from_rad: number(-1000, 1000),
    speed_m_s: number(0, 1000),
  },
  ['from_rad', 'speed_m_s'],
);

const gps = object<Gps>(
  {
    fix: text,
    satellites: number(0, 1000),
    hdop: number(0, 1000000),
  },
  ['fix'],
);

const estimator = object<Estimator>(
  {
    velocity: number(-1000000, 1000000),
    position_horizontal: number(-1000000, 1000000),
    position_vertical: number(-1000000, 1000000),
    compass: number(-1000000, 1000000),
  },
  [],
);

const battery = object<Battery>(
  {
    id: number(0, 9007199254740991),
    remaining: number(0, 1),
    voltage_v: number(0, 10000),
    current_a: number(-10000, 10000),
    consumed_ah: number(0, 1000000),
    time_left_s: number(0, 1000000000),
    time_left_is_estimate: flag,
    time_left_error_s: number(0, 1000000000),
    in_flight_s: number(0, 1000000000),
    in_flight_error_s: number(0, 1000000000),
  },
  ['remaining'],
);

const health = object<Health>(
  {
    position_ok: flag,
    prearm_ok: flag,
  },
  ['position_ok', 'prearm_ok'],
);

const missionProgress = object<MissionProgress>(
  {
    current: number(0, 9007199254740991),
    total: number(0, 9007199254740991),
    complete: flag,
    state: text,
  },
  ['current', 'total', 'complete'],
);

const fence = object<Fence>(
  {
    breached: flag,
    breaches: number(0, 9007199254740991),
    type: text,
  },
  ['breached', 'breaches'],
);

const gimbal = object<Gimbal>(
  {
    roll_rad: number(-1000, 1000),
    pitch_rad: number(-1000, 1000),
    yaw_rad: number(-1000, 1000),
    yaw_is_from_north: flag,
  },
  ['roll_rad', 'pitch_rad', 'yaw_rad', 'yaw_is_from_north'],
);

const component = object<Component>(
  {
    id: number(0, 9007199254740991),
    kind: text,
    state: text,
    model: text,
  },
  ['id', 'kind'],
);

const pictureCount = object<PictureCount>(
  {
    taken: number(0, 9007199254740991),
    lost: number(0, 9007199254740991),
  },
  ['taken', 'lost'],
);

const carrier = object<Carrier>(
  {
    asked_speed_m_s: number(-1000, 1000),
    asked_yaw_rad: number(-1000, 1000),
    completed: flag,
    avoids_obstacle: flag,
    killed: flag,
  },
  ['asked_speed_m_s', 'completed', 'avoids_obstacle', 'killed'],
);

export const VEHICLE: Shape<VehicleFields> = {
  system_id: number(0, 9007199254740991),
  name: text,
  family: word(['copter', 'plane', 'vtol', 'rover', 'boat', 'sub', 'robot', 'unknown'], 'unknown'),
  autopilot: text,
  mode: text,
  texts: list(said),
  control,
  foreign_change: text,
  connection: word(['ok', 'lost', 'conflict']),
  link: text,
  links: list(linkQuality, ({ name }) => name),
  heartbeat: flag,
  silent: flag,
  remote_control: remoteControl,
  radio,
  landed: flag,
  position,
  site_pose: sitePose,
  relative_alt_m: number(-10000000, 10000000),
  velocity_m_s: velocity,
  attitude_rad: attitude,
  heading_rad: number(-1000, 1000),
  hud,
  wind,
  home: position,
  track_m: number(0, 1000000000),
  gps,
  estimator,
  battery,
  further_batteries: list(battery),
  armed: flag,
  health,
  unhealthy: list(text, (value) => value),
  arming_reasons: list(text, (value) => value),
  mission: missionProgress,
  waypoint_distance_m: number(0, 100000000),
  fence,
  payload: list(text, (value) => value),
  gimbal,
  components: list(component, ({ id }) => id),
  pictures: pictureCount,
  carrier,
};
