import { expect, it } from 'vitest';
import { detailsOf, OLD_S } from './details';
import type { VehicleFields } from './protocol';

const NOW = 100_000;
const rows = (fields: VehicleFields, heardAt: Record<string, number> = {}) =>
  detailsOf({ id: '1', fields, heardAt }, NOW).flatMap(({ title, rows }) => rows.map((row) => ({ title, ...row })));

it('tells nothing of what was never heard', () => {
  expect(detailsOf({ id: '1', fields: {}, heardAt: {} }, NOW)).toEqual([]);
  expect(rows({ unhealthy: [], arming_reasons: [], texts: [] })).toEqual([]);
});

it('says first why a vehicle cannot arm, in its own words', () => {
  const [first] = rows({ arming_reasons: ['PreArm: Compass not calibrated'], battery: { remaining: 1, time_left_s: 60 } });
  expect(first).toEqual({ title: 'Cannot arm', label: '', value: 'Compass not calibrated', level: 'warning' });
});

it.each<[VehicleFields, string]>([
  [{ battery: { remaining: 0.5, time_left_s: 720 } }, '12 min'],
  [{ battery: { remaining: 0.5, time_left_s: 720, time_left_is_estimate: true, time_left_error_s: 60 } }, 'about 12 min'],
  [{ battery: { remaining: 0.5, time_left_s: 1050, time_left_is_estimate: true, time_left_error_s: 150, in_flight_s: 1050 } }, '15–20 min'],
  [{ battery: { remaining: 0.5, in_flight_s: 840, in_flight_error_s: 60 } }, 'about 14 min, by its last flight'],
  [{ battery: { remaining: 0.5, voltage_v: 15.21, current_a: 8, consumed_ah: 1.5 } }, '15.2 V, 8.0 A, 1.50 Ah used'],
  [{ gps: { fix: 'RTK fixed', satellites: 14, hdop: 0.71 } }, 'RTK fixed, 14 satellites, HDOP 0.7'],
  [{ gps: { fix: 'no GPS' } }, 'no GPS'],
  [{ wind: { from_rad: Math.PI / 2, speed_m_s: 3 } }, '3.0 m/s from 090°'],
  [{ remote_control: { lost: true, channels: 0, pulses_us: [] } }, 'none'],
  [{ remote_control: { lost: true, channels: 8, pulses_us: [] } }, 'lost'],
  [{ remote_control: { lost: false, channels: 8, rssi: 0.5, pulses_us: [] } }, '8 channels, signal 50 %'],
  [{ gimbal: { roll_rad: 0, pitch_rad: -Math.PI / 2, yaw_rad: 0, yaw_is_from_north: true } }, '90° down, towards 000°'],
  [{ gimbal: { roll_rad: 0, pitch_rad: 0, yaw_rad: Math.PI / 2, yaw_is_from_north: false } }, 'level, 090° of the nose'],
  [{ pictures: { taken: 12, lost: 2 } }, '12, of 2 the place is not known'],
  [{ site_pose: { site: 'office', floor: '1', x_m: 3.14, y_m: -2, z_m: 0, yaw_rad: 0 } }, 'office, floor 1: 3.1 east, -2.0 north'],
  [{ carrier: { asked_speed_m_s: 0.16, completed: true, avoids_obstacle: false, killed: false } }, 'goes 0.2 m/s'],
  [{ carrier: { asked_speed_m_s: 0.16, completed: false, avoids_obstacle: true, killed: false } }, 'backs away from an obstacle'],
  [{ carrier: { asked_speed_m_s: 0.16, completed: false, avoids_obstacle: true, killed: true } }, 'killed'],
  [{ components: [{ id: 154, kind: 'gimbal', state: 'active', model: 'Maker G' }] }, 'Maker G, active'],
])('%j reads %s', (fields, value) => {
  expect(rows(fields).map((row) => row.value)).toEqual([value]);
});

it('tells the age of what is old only, and of each component its own', () => {
  const fields: VehicleFields = { hud: { airspeed_m_s: 1, climb_m_s: 0, throttle: 0 }, components: [{ id: 100, kind: 'camera' }] };
  const young = rows(fields, { hud: NOW - 1000, component_100: NOW - 1000 });
  expect(young.every(({ age }) => age === undefined)).toBe(true);
  const old = rows(fields, { hud: NOW - 1000, component_100: NOW - OLD_S * 1000 });
  expect(old.filter(({ age }) => age !== undefined)).toMatchObject([{ label: 'Camera', age: OLD_S }]);
});

it('names what the estimator does not believe', () => {
  const estimator = { velocity: 0.1, position_horizontal: 0.1, position_vertical: 0.1 };
  expect(rows({ estimator })[0]).toMatchObject({ value: 'good' });
  expect(rows({ estimator: { ...estimator, compass: 0.7 } })[0]).toMatchObject({ value: 'compass 0.7', level: 'warning' });
  expect(rows({ estimator: { ...estimator, position_vertical: 1.2 } })[0]).toMatchObject({ value: 'height 1.2', level: 'critical' });
});

it('shows a fence only when it is breached, and the distance only on a mission', () => {
  expect(rows({ fence: { breached: false, breaches: 1 } })).toEqual([]);
  expect(rows({ fence: { breached: true, breaches: 1, type: 'boundary' } })[0]).toMatchObject({
    value: 'breached: boundary',
    level: 'critical',
  });
  expect(rows({ waypoint_distance_m: 50, mission: { current: 1, total: 3, complete: false, state: 'not started' } })).toHaveLength(1);
  expect(rows({ waypoint_distance_m: 50, mission: { current: 1, total: 3, complete: false, state: 'active' } })).toHaveLength(2);
});

it('shows the newest texts first, by their severity', () => {
  const texts = Array.from({ length: 9 }, (_, index) => ({ severity: index === 8 ? 2 : 6, text: `text ${index}` }));
  const shown = rows({ texts });
  expect(shown.map(({ value }) => value)).toEqual(['text 8', 'text 7', 'text 6', 'text 5', 'text 4']);
  expect(shown[0]).toMatchObject({ level: 'critical' });
  expect(rows({ texts: [{ severity: 4, text: 'card full', component: 100 }] })[0]).toMatchObject({ label: '100', level: 'warning' });
});

it('names links where there are several, and warns of silent ones', () => {
  const link = {
    name: 'udpin://0.0.0.0:14550 from 10.0.0.2:14555',
    loss: 0.02,
    messages_per_s: 20,
    bytes_per_s: 900,
    round_trip_s: 0.12,
    alive: true,
    used: true,
  };
  expect(rows({ links: [link] })).toEqual([{ title: 'Links', label: 'In use', value: '2 % lost, 120 ms, 20 messages/s' }]);
  const radio = { ...link, name: 'serial:///dev/ttyUSB0:57600', alive: false, used: false };
  expect(rows({ links: [link, radio] }).map(({ label, value, level }) => [label, value, level])).toEqual([
    ['In use', 'udpin://0.0.0.0:14550: 2 % lost, 120 ms, 20 messages/s', undefined],
    ['Spare', 'serial:///dev/ttyUSB0:57600: silent', 'warning'],
  ]);
});

it('gives every value of a silent vehicle its age: it is the last that is known', () => {
  const fields: VehicleFields = {
    gps: { fix: '3D' },
    links: [{ name: 'udp', messages_per_s: 0, bytes_per_s: 0, alive: true, used: true }],
  };
  expect(rows(fields, { gps: NOW - 4000 })[0]).not.toHaveProperty('age');
  const [gps, link] = rows({ ...fields, silent: true }, { gps: NOW - 4000 });
  expect(gps).toMatchObject({ value: '3D', age: 4 });
  expect(link?.value).toMatch(/^loss unknown/);
});
