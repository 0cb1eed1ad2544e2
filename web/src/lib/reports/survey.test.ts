import { expect, it } from 'vitest';
import { canFly, conditionOf, inNeed, surveyOf, type SurveyDrone } from './survey';

const hawk: SurveyDrone = { name: 'hawk', connected: true, words: [], state: 'Hover', healthy: true };

it('reads what can be read and leaves out the rest', () => {
  const drones = surveyOf({
    drones: [{ ...hawk, battery: 0.5, height_m: 'high', slots: { free: 1, taken: 2, unknown: 0 } }, { name: 7 }, 'nonsense'],
  });
  expect(drones).toEqual([{ ...hawk, battery: 0.5, slots: { free: 1, taken: 2, unknown: 0 } }]);
  expect(surveyOf(undefined)).toEqual([]);
});

it.each([
  [{}, 'active', 'hovering'],
  [{ connected: false, trouble: 'connection refused' }, 'lost', 'not connected: connection refused'],
  [{ state: undefined }, 'lost', 'connected, has said nothing yet'],
  [{ state: 'Malfunction' }, 'critical', 'coming home: malfunction'],
  [{ state: 'Dancing' }, 'warning', 'Dancing'],
])('says in words how it is: %o', (more: Partial<SurveyDrone>, level, text) => {
  expect(conditionOf({ ...hawk, ...more })).toMatchObject({ level, text });
});

it('counts who needs somebody', () => {
  expect(inNeed([hawk, { ...hawk, healthy: false }, { ...hawk, connected: false }])).toBe(2);
});

it('knows when a drone takes commands to fly', () => {
  expect(canFly(hawk)).toBe(true);
  expect(canFly({ ...hawk, state: 'Idle' })).toBe(false);
  expect(canFly({ ...hawk, connected: false })).toBe(false);
});
