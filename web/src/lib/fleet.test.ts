import { describe, expect, it } from 'vitest';
import { addPictures, ageOf, compareIds, groundSpeed, mergeUpdates, summaryOfKinds, type Vehicle } from './fleet';

describe('mergeUpdates', () => {
  const first = mergeUpdates(new Map(), [{ id: '1', mode: 'AUTO', armed: true, age_s: { mode: 0.5, armed: 0 } }], true, 10_000);

  it('changes only what an update names', () => {
    const merged = mergeUpdates(first, [{ id: '1', mode: 'RTL', age_s: { mode: 0 } }], false, 12_000);
    expect(merged.get('1')?.fields).toEqual({ mode: 'RTL', armed: true });
    expect(merged.get('1')?.heardAt).toEqual({ mode: 12_000, armed: 10_000 });
  });

  it('takes an age alone for a value heard again', () => {
    const merged = mergeUpdates(first, [{ id: '1', age_s: { mode: 0.1 } }], false, 20_000);
    expect(merged.get('1')?.fields.mode).toBe('AUTO');
    expect(ageOf(merged.get('1')!, 'mode', 20_000)).toBeCloseTo(0.1);
  });

  it('leaves the fleet before it as it was', () => {
    mergeUpdates(first, [{ id: '1', mode: 'RTL' }], false, 12_000);
    expect(first.get('1')?.fields.mode).toBe('AUTO');
  });

  it('forgets what a full message does not name', () => {
    const merged = mergeUpdates(first, [{ id: '2' }], true, 12_000);
    expect([...merged.keys()]).toEqual(['2']);
    const again = mergeUpdates(first, [{ id: '1', mode: 'LAND' }], true, 12_000);
    expect(again.get('1')?.fields).toEqual({ mode: 'LAND' });
  });

  it('orders vehicles by number', () => {
    const merged = mergeUpdates(new Map(), [{ id: '10' }, { id: '9' }, { id: 'a1' }, { id: '1' }], true, 0);
    expect([...merged.keys()]).toEqual(['1', '9', '10', 'a1']);
    expect(compareIds('2', '2')).toBe(0);
  });
});

describe('ages', () => {
  const vehicle: Vehicle = { id: '1', fields: {}, heardAt: { heartbeat: 1000 } };

  it('grow on this clock', () => expect(ageOf(vehicle, 'heartbeat', 3500)).toBe(2.5));
  it('are unknown for what was never heard', () => expect(ageOf(vehicle, 'mode', 3500)).toBeUndefined());
  it('are never negative', () => expect(ageOf(vehicle, 'heartbeat', 900)).toBe(0));
});

describe('groundSpeed', () => {
  it('leaves out the climb', () => {
    expect(groundSpeed({ id: '1', fields: { velocity_m_s: { north: 3, east: 4, down: 9 } }, heardAt: {} })).toBe(5);
  });
  it('is unknown without a velocity', () => expect(groundSpeed({ id: '1', fields: {}, heardAt: {} })).toBeUndefined());
});

it('adds pictures behind those that it has, each once', () => {
  const picture = (number: number) => ({ number, lat_deg: 1, lon_deg: 2, alt_m: 3, relative_alt_m: 20 });
  let known = addPictures(new Map(), '1', [picture(1), picture(2)], true);
  known = addPictures(known, '1', [picture(2), picture(3)], false);
  expect(known.get('1')!.map(({ number }) => number)).toEqual([1, 2, 3]);
  known = addPictures(known, '1', [picture(1)], true); // the station was started anew
  expect(known.get('1')).toHaveLength(1);
});

it('tells of many by their kinds', () => {
  const of = (family?: 'copter' | 'rover'): Vehicle => ({ id: '1', fields: family ? { family } : {}, heardAt: {} });
  expect(summaryOfKinds([of('copter'), of('rover'), of('copter'), of()])).toBe('2 copters, 1 rover, 1 vehicle');
});
