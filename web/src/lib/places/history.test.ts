import { describe, expect, it } from 'vitest';
import type { Vehicle } from '../fleet';
import { History, HISTORY_S, linePath, linkShare, rangeOf } from './history';

const vehicle = (id: string, fields: Vehicle['fields'] = {}): Vehicle => ({ id, fields, heardAt: {} });

describe('the history of a vehicle', () => {
  it('has a sample a second, however often it is told of', () => {
    const history = new History();
    for (let now = 0; now <= 3000; now += 200) history.note([vehicle('1', { relative_alt_m: now })], now);
    expect(history.of('1').map(({ height_m }) => height_m)).toEqual([0, 1000, 2000, 3000]);
    expect(history.of('2')).toEqual([]);
  });

  it('keeps a few minutes, and nothing of who is gone', () => {
    const history = new History();
    for (let now = 0; now < 1000 * (HISTORY_S + 100); now += 1000) history.note([vehicle('1'), vehicle('2')], now);
    expect(history.of('1')).toHaveLength(HISTORY_S);
    history.note([vehicle('2')], 1e9);
    expect(history.of('1')).toEqual([]);
  });
});

it('takes nothing as coming through from who is silent, and knows nothing where nothing is told', () => {
  const link = { name: 'a', messages_per_s: 1, bytes_per_s: 1, alive: true };
  expect(linkShare(vehicle('1', { silent: true, links: [{ ...link, used: true, loss: 0 }] }))).toBe(0);
  expect(linkShare(vehicle('1', { links: [{ ...link, used: false, loss: 0.5 }, { ...link, used: true, loss: 0.25 }] }))).toBe(0.75); // prettier-ignore
  expect(linkShare(vehicle('1', { links: [{ ...link, used: true }] }))).toBeUndefined();
});

describe('a line', () => {
  it('ends at the right, and has gaps where nothing is known', () => {
    expect(linePath([0, 5, undefined, 10], 11, [0, 10], 100, 20)).toBe('M70.0 20.0L80.0 10.0M100.0 0.0');
    expect(linePath([], 11, [0, 10], 100, 20)).toBe('');
  });
  it('stays within its box', () => expect(linePath([99, -99], 2, [0, 1], 10, 10)).toBe('M0.0 0.0L10.0 10.0'));
  it('has a range that does not blow up noise', () => {
    expect(rangeOf([20, 20.1, undefined], 10)).toEqual([15, 26]);
    expect(rangeOf([0, 120], 10)).toEqual([0, 120]);
    expect(rangeOf([], 10)).toEqual([0, 10]);
  });
});
