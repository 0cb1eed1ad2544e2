import { describe, expect, it } from 'vitest';
import {
  commandedByOthers,
  commonModes,
  destinationsOf,
  headlineOf,
  isStop,
  latestFor,
  requestOf,
  requestsTo,
  stateOf,
  stopSummary,
  summaryOf,
  titleOf,
} from './commands';
import type { Vehicle } from './fleet';
import type { Command, VehicleFields } from './protocol';

const vehicle = (id: string, fields: VehicleFields): Vehicle => ({ id, fields, heardAt: {} });
const command = (rest: Partial<Command>): Command => ({ number: 1, action: 'arm', by: 'me', asked: '', vehicles: [], ...rest });

describe('commands', () => {
  it('have a title with what they need', () => {
    expect(titleOf(command({ action: 'take_off', height_m: 15 }))).toBe('Take off, 15 m');
    expect(titleOf(command({ action: 'set_mode', mode: 'GUIDED' }))).toBe('Set mode GUIDED');
    expect(titleOf(command({}))).toBe('Arm');
  });

  it('sum up what vehicles made of them', () => {
    const states = ['confirmed', 'confirmed', 'refused', 'accepted', 'expired'] as const;
    const vehicles = states.map((state, index) => ({ vehicle: String(index), state }));
    expect(summaryOf(command({ vehicles }))).toBe('2 of 5 confirmed, 2 failed, 1 under way');
    expect(summaryOf(command({ vehicles: [{ vehicle: '1', state: 'confirmed' }] }))).toBe('1 of 1 confirmed');
    const flying = (['confirmed', 'under_way', 'cut_short'] as const).map((state, index) => ({ vehicle: String(index), state }));
    expect(summaryOf(command({ action: 'take_off', vehicles: flying }))).toBe('1 of 3 reached, 1 cut short, 1 under way');
  });

  it('have a word and a sign of their own in each state', () => {
    const states = ['waiting', 'accepted', 'under_way', 'confirmed', 'refused', 'timed_out', 'expired', 'superseded', 'cut_short'] as const;
    const all = states.map((state) => stateOf(state, 'arm'));
    expect(new Set(all.map(({ word }) => word)).size).toBe(all.length);
    expect(stateOf('confirmed', 'take_off').word).toBe('reached');
    expect(stateOf('confirmed', 'land').word).toBe('landed');
  });

  it('tell in one line how far one vehicle is, and of several the sum', () => {
    const climbing = { vehicle: '1', state: 'under_way' as const, reason: 'at 7 of 20 m', left_m: 13 };
    const takeOff = command({ action: 'take_off', height_m: 20, vehicles: [climbing] });
    expect(headlineOf(takeOff)).toMatchObject({ text: 'Take off, 20 m: under way, at 7 of 20 m', level: 'active' });
    const both = {
      ...takeOff,
      vehicles: [climbing, { vehicle: '2', state: 'cut_short' as const, reason: 'emergency stop by anna, at 9 of 20 m' }],
    };
    expect(headlineOf(both)).toMatchObject({ text: 'Take off, 20 m: 0 of 2 reached, 1 cut short, 1 under way', level: 'warning' });
  });

  it('concern those that are selected, whatever others were told since', () => {
    const land = command({
      number: 1,
      action: 'land',
      vehicles: [
        { vehicle: '1', state: 'under_way' },
        { vehicle: '2', state: 'refused' },
      ],
    });
    const arm = command({ number: 2, vehicles: [{ vehicle: '3', state: 'confirmed' }] });
    expect(latestFor([land, arm], ['1'])).toEqual({ ...land, vehicles: [{ vehicle: '1', state: 'under_way' }] });
    expect(latestFor([land, arm], ['1', '3'])?.number).toBe(2);
    expect(latestFor([land, arm], ['9'])).toBeUndefined();
  });

  it('have a destination until the vehicle is there', () => {
    const place = { lat_deg: 1, lon_deg: 2, alt_m: 0 };
    const other = { ...place, lon_deg: 3 };
    const goTo = (number: number, at: typeof place, ...vehicles: Command['vehicles']): Command =>
      command({ number, action: 'go_to', place: at, vehicles });
    const open = goTo(
      1,
      place,
      { vehicle: '1', state: 'under_way', left_m: 312.4 },
      { vehicle: '2', state: 'accepted' },
      { vehicle: '3', state: 'under_way', left_m: 2345 },
    );
    expect(destinationsOf([open])).toEqual([
      { vehicle: '1', place, left: '312 m' },
      { vehicle: '2', place, left: 'acknowledged' },
      { vehicle: '3', place, left: '2.3 km' },
    ]);
    const later = goTo(2, other, { vehicle: '1', state: 'waiting' });
    const cut = goTo(1, place, { vehicle: '1', state: 'cut_short' }, { vehicle: '2', state: 'confirmed' });
    expect(destinationsOf([cut, later])).toEqual([{ vehicle: '1', place: other, left: 'sent' }]);
    expect(destinationsOf([command({ action: 'take_off', vehicles: [{ vehicle: '1', state: 'under_way' }] })])).toEqual([]);
  });

  it('need no confirmation when they bring a vehicle to rest', () => {
    expect((['hold', 'land', 'rtl', 'disarm', 'pause_mission'] as const).every(isStop)).toBe(true);
    expect((['arm', 'take_off', 'go_to', 'set_mode', 'start_mission', 'resume_mission'] as const).some(isStop)).toBe(false);
  });
});

describe('who commands', () => {
  const fleet = [
    vehicle('1', { name: 'copter 1', control: { commander: 'me' } }),
    vehicle('2', { control: { commander: 'script' } }),
    vehicle('3', { control: { commander: '' } }),
    vehicle('4', {}),
  ];

  it('names those whom somebody else commands', () => {
    expect(commandedByOthers(fleet, 'me')).toEqual([{ id: '2', name: '2', by: 'script' }]);
  });

  it('finds requests to this operator alone', () => {
    const asked = [
      vehicle('1', { name: 'copter 1', control: { commander: 'me', asked_for_by: 'ben', granted_at_s: 12 } }),
      vehicle('2', { control: { commander: 'anna', asked_for_by: 'ben', granted_at_s: 12 } }),
    ];
    expect(requestsTo(asked, 'me')).toEqual([{ id: '1', name: 'copter 1', by: 'ben', granted_at_s: 12 }]);
    expect(requestsTo(fleet, 'me')).toEqual([]);
  });
});

it('counts what has been stopped', () => {
  const one = { vehicle: '1', acknowledged: true, confirmed: true, tries: 1, detail: '' };
  const two = { vehicle: '2', acknowledged: true, confirmed: false, tries: 3, detail: '' };
  expect(stopSummary({ latched: true, action: 'hold', by: 'me', vehicles: [one, two] })).toBe('1 of 2 stopped, 2 acknowledged');
});

it('offers the modes that all vehicles have', () => {
  const copter = vehicle('1', { family: 'copter', autopilot: 'ardupilot' });
  const rover = vehicle('2', { family: 'rover', autopilot: 'ardupilot' });
  const px4 = vehicle('3', { family: 'copter', autopilot: 'px4' });
  expect(commonModes([copter])).toContain('BRAKE');
  expect(commonModes([copter, rover])).toEqual(['LOITER', 'GUIDED', 'AUTO', 'RTL', 'SMART_RTL']);
  expect(commonModes([px4])).toContain('AUTO.RTL');
  expect(commonModes([copter, px4])).toEqual([]);
  expect(commonModes([])).toEqual([]);
});

it('knows whether it was I who asked', () => {
  const vehicle = { id: '1', fields: { control: { commander: 'operator 1', asked_for_by: 'operator 2', granted_at_s: 12 } }, heardAt: {} };
  expect(requestOf(vehicle, 'operator 2')).toEqual({ by: 'operator 2', isMine: true, granted_at_s: 12 });
  expect(requestOf(vehicle, 'operator 3')?.isMine).toBe(false);
  expect(requestOf({ ...vehicle, fields: {} }, 'operator 2')).toBeUndefined();
});
