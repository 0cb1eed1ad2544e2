// Made from src/station/fields/vehicle_fields.cpp by `station_fields write`. Do not change it here.

export type Family = 'copter' | 'plane' | 'vtol' | 'rover' | 'boat' | 'sub' | 'robot' | 'unknown';

export interface Said {
  /** As syslog: 0 emergency to 7 debug. */
  severity: number;
  text: string;
  /** Who said it; missing for the autopilot. */
  component?: number;
}

/** Who commands a vehicle, and who wants to. */
export interface Control {
  /** An operator, `script`, or nobody: empty. */
  commander: string;
  /** Who asks him for it. */
  asked_for_by?: string;
  /** By the clock of the message's `time_s`. */
  granted_at_s?: number;
}

export type Link = 'ok' | 'lost' | 'conflict';

/** One of the links on which a vehicle is heard, over the last 10 s. */
export interface LinkQuality {
  name: string;
  /** Missing while nothing is heard on it. */
  loss?: number;
  messages_per_s: number;
  bytes_per_s: number;
  /** By TIMESYNC; missing until it was measured. */
  round_trip_s?: number;
  /** Not silent for longer than is usual for it. */
  alive: boolean;
  /** Commands go over it. */
  used: boolean;
}

export interface RemoteControl {
  lost: boolean;
  channels: number;
  rssi?: number;
  /** Null: not used. */
  pulses_us: (number | null)[];
}

/** The telemetry radio's own view of its link. */
export interface Radio {
  /** In the radio's own units, 0 to 254, as the next three. */
  rssi?: number;
  remote_rssi?: number;
  noise?: number;
  remote_noise?: number;
  buffer_free?: number;
  receive_errors: number;
}

export interface Position {
  lat_deg: number;
  lon_deg: number;
  /** Above mean sea level. */
  alt_m: number;
}

/** Where it is in the frame of a site, and where it looks. */
export interface SitePose {
  site: string;
  floor?: string;
  /** East of the site's anchor. */
  x_m: number;
  /** North of it. */
  y_m: number;
  /** Above it. */
  z_m: number;
  /** Counterclockwise from the x axis. */
  yaw_rad: number;
}

export interface Velocity {
  north: number;
  east: number;
  down: number;
}

export interface Attitude {
  roll: number;
  pitch: number;
  yaw: number;
}

export interface Hud {
  airspeed_m_s?: number;
  climb_m_s?: number;
  throttle?: number;
}

export interface Wind {
  from_rad: number;
  speed_m_s: number;
}

export interface Gps {
  /** "no fix", "3D", "RTK fixed" ... */
  fix: string;
  satellites?: number;
  hdop?: number;
}

export interface Estimator {
  velocity?: number;
  position_horizontal?: number;
  position_vertical?: number;
  compass?: number;
}

export interface Battery {
  /** Not for the first one. */
  id?: number;
  remaining: number;
  voltage_v?: number;
  current_a?: number;
  consumed_ah?: number;
  /** At what the vehicle does now. */
  time_left_s?: number;
  /** Ours: the vehicle does not say. */
  time_left_is_estimate?: boolean;
  /** Of an estimate, to either side. */
  time_left_error_s?: number;
  /** What is left would last so long in flight, by this flight or the last one. */
  in_flight_s?: number;
  in_flight_error_s?: number;
}

export interface Health {
  position_ok: boolean;
  prearm_ok: boolean;
}

export interface MissionProgress {
  current: number;
  total: number;
  complete: boolean;
  state?: string;
}

export interface Fence {
  breached: boolean;
  breaches: number;
  type?: string;
}

export interface Gimbal {
  roll_rad: number;
  /** Negative is down. */
  pitch_rad: number;
  yaw_rad: number;
  /** Otherwise from the vehicle's nose. */
  yaw_is_from_north: boolean;
}

/** What else is aboard; its age is that of the key component_ID. */
export interface Component {
  id: number;
  kind: string;
  state?: string;
  model?: string;
}

export interface PictureCount {
  taken: number;
  /** Taken, but nobody told where. */
  lost: number;
}

/** What a robot's carrier was asked, and whether it does so. */
export interface Carrier {
  asked_speed_m_s: number;
  asked_yaw_rad?: number;
  /** It goes as it was asked to. */
  completed: boolean;
  avoids_obstacle: boolean;
  /** It stands until an operator lets it go again. */
  killed: boolean;
}

/** What may be known about a vehicle; a key that is missing was never heard. */
export interface VehicleFields {
  /** MAVLink's; 0 for what has none. */
  system_id?: number;
  /** "copter 1". */
  name?: string;
  family?: Family;
  /** `ardupilot`, `px4` or `other`. */
  autopilot?: string;
  /** The autopilot's own name. */
  mode?: string;
  /** Newest last. */
  texts?: Said[];
  control?: Control;
  /** The last thing that happened to it without this station. */
  foreign_change?: string;
  connection?: Link;
  /** Over which it is commanded. */
  link?: string;
  links?: LinkQuality[];
  /** True: its age is what counts. */
  heartbeat?: boolean;
  /** Nothing has come from it for some seconds; its age is that of the silence. */
  silent?: boolean;
  /** `null` among `pulses_us`: not used. */
  remote_control?: RemoteControl;
  radio?: Radio;
  landed?: boolean;
  position?: Position;
  /** Of what moves in a site's frame: robots indoors. */
  site_pose?: SitePose;
  /** Above home. */
  relative_alt_m?: number;
  velocity_m_s?: Velocity;
  attitude_rad?: Attitude;
  /** Clockwise from true north. */
  heading_rad?: number;
  hud?: Hud;
  wind?: Wind;
  home?: Position;
  /** Travelled since it was discovered. */
  track_m?: number;
  gps?: Gps;
  /** 0.5 deserves a look, above 1 the sensor is not believed. */
  estimator?: Estimator;
  battery?: Battery;
  /** As old as the oldest. */
  further_batteries?: Battery[];
  armed?: boolean;
  health?: Health;
  /** Sensors that are there, enabled and sick. */
  unhealthy?: string[];
  /** Why it will not arm, in its own words; gone when the checks pass, when it arms, or when they are not repeated for 75 s. */
  arming_reasons?: string[];
  mission?: MissionProgress;
  /** To where it is bound for. */
  waypoint_distance_m?: number;
  fence?: Fence;
  /** Equipment by the names that scripts ask for. */
  payload?: string[];
  gimbal?: Gimbal;
  /** Cameras, gimbals, companion computers; the age of each is `component_ID` in `age_s`. */
  components?: Component[];
  /** `lost`: taken, but nobody told where. */
  pictures?: PictureCount;
  /** Of robots. */
  carrier?: Carrier;
}
