import { describe, expect, it } from 'vitest';
import { arrange, judgeWith, type Arrangement } from './attention';
import type { Vehicle } from './fleet';
import { USUAL_LIMITS } from './status';

const vehicle = (id: string, fields: Vehicle['fields']): Vehicle => ({
  id,
  fields: { name: `copter ${id}`, family: 'copter', ...fields },
  heardAt: {},
});
const fleet = [
  vehicle('1', { armed: true, landed: false }),
  vehicle('2', { battery: { remaining: 0.2 } }),
  vehicle('3', { connection: 'lost', name: 'rover 3', family: 'rover' }),
  vehicle('4', { connection: 'conflict' }),
  vehicle('5', { mode: 'LOITER' }),
];
const told = (how: Partial<Arrangement> = {}): string[] =>
  arrange(fleet, { words: '', grouping: 'none', order: 'attention', ...how }, judgeWith(false, USUAL_LIMITS)).map((entry) =>
    entry.kind === 'head' ? `${entry.title} ${entry.count}` : entry.id,
  );

describe('the order of the fleet', () => {
  it('has who needs attention first', () => expect(told()).toEqual(['4', '3', '2', '1', '5']));
  it('can be that of the ids', () => expect(told({ order: 'id' })).toEqual(['1', '2', '3', '4', '5']));
  it('has groups by kind, that of who needs attention first at the top', () => {
    expect(told({ grouping: 'kind' })).toEqual(['Copter 4', '4', '2', '1', '5', 'Rover 1', '3']);
  });
  it('has groups by state', () => {
    expect(told({ grouping: 'state', words: 'copter' })).toEqual(['Critical 1', '4', 'Warning 1', '2', 'Active 1', '1', 'Ready 1', '5']);
  });
  it('finds by name, state and mode', () => {
    expect(told({ words: 'rover' })).toEqual(['3']);
    expect(told({ words: 'low copter' })).toEqual(['2']);
    expect(told({ words: 'loit' })).toEqual(['5']);
    expect(told({ words: 'nobody' })).toEqual([]);
  });
});
