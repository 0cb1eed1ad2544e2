import { describe, expect, it } from 'vitest';
import type { Vehicle } from '../fleet';
import { homeDistance, targetOf, targetText } from './intent';
import type { Command, Position } from '../protocol';

const DEGREE = 111_319.49;
const at = (north: number, east: number, alt_m = 100): Position => ({ lat_deg: north / DEGREE, lon_deg: east / DEGREE, alt_m });
const vehicle = (fields: Vehicle['fields'] = {}): Vehicle => ({
  id: '1',
  fields: { position: at(0, 0), home: at(30, 40, 80), velocity_m_s: { north: 0, east: 5, down: 0 }, ...fields },
  heardAt: {},
});
const goTo = (state: 'under_way' | 'confirmed', place = at(0, 50, 110)): Command => ({ number: 1, action: 'go_to', by: 'a', asked: '', place, vehicles: [{ vehicle: '1', state }] }); // prettier-ignore
const active = { mission: { current: 2, total: 5, complete: false, state: 'active' } };

describe('where a vehicle is bound for', () => {
  it('is where a command sends it, with height and time to go', () => {
    const target = targetOf(vehicle(), [goTo('under_way')])!;
    expect(target.distance_m).toBeCloseTo(50, 1);
    expect(targetText(target)).toBe('at 30 m, 50 m to go, 10 s');
    expect(targetOf(vehicle(), [goTo('confirmed')])).toBeUndefined();
  });

  it('is the place of its mission that it flies to, of those at the distance that it tells', () => {
    const path = [at(0, -80), at(80, 0), at(0, 80), at(0, 20)];
    const target = targetOf(vehicle({ ...active, waypoint_distance_m: 79 }), [], path)!;
    expect(target.place).toBe(path[2]);
  });

  it('is not guessed where no place is so far away, or no mission runs', () => {
    expect(targetOf(vehicle({ ...active, waypoint_distance_m: 30 }), [], [at(0, 80)])).toBeUndefined();
    expect(targetOf(vehicle({ waypoint_distance_m: 80 }), [], [at(0, 80)])).toBeUndefined();
  });

  it('has no time to go for who does not go', () => {
    const target = targetOf(vehicle({ velocity_m_s: { north: 0, east: 0.1, down: 0 } }), [goTo('under_way')])!;
    expect(target.time_s).toBeUndefined();
  });
});

it('knows how far home is', () => {
  expect(homeDistance(vehicle())).toBeCloseTo(50, 1);
  expect(homeDistance({ id: '1', fields: {}, heardAt: {} })).toBeUndefined();
});
