import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { objectionsTo, RULES } from './plausibility';
import type { Command } from './protocol';

const REFUSED = 'the place is 12 km away; 5.0 km is the limit [too_far]';
const goTo = (rest: Partial<Command> = {}): Command => ({
  number: 1,
  action: 'go_to',
  by: 'me',
  asked: '',
  vehicles: [{ vehicle: '1', state: 'refused', reason: REFUSED, rule: 'too_far' }],
  ...rest,
});

describe('rules of plausibility', () => {
  it('are those of the reference', () => {
    const table = readFileSync('../docs/reference/plausibility.md', 'utf8').split('## Rules')[1]!.split('\n## ')[0]!;
    expect([...RULES.keys()]).toEqual([...table.matchAll(/^\| `(\w+)` \|/gm)].map(([, rule]) => rule));
  });

  it('stand against the vehicles that were refused by them', () => {
    const vehicles: Command['vehicles'] = [
      { vehicle: '1', state: 'refused', reason: REFUSED, rule: 'too_far' },
      { vehicle: '2', state: 'under_way', reason: REFUSED, rule: 'too_far' },
      { vehicle: '3', state: 'refused', reason: REFUSED, rule: 'too_far' },
      { vehicle: '4', state: 'refused', reason: 'it would end in the ground', rule: 'below_ground' },
      { vehicle: '5', state: 'refused', reason: 'vehicle 5 is commanded by ben' },
      { vehicle: '6', state: 'refused', reason: 'PreArm: check [too_far]' },
      { vehicle: '7', state: 'refused', reason: 'by a rule of a later station', rule: 'too_bright' },
    ];
    expect(objectionsTo(goTo({ vehicles }), [], 'me')).toEqual([
      { rule: 'too_far', vehicles: ['1', '3'] },
      { rule: 'below_ground', vehicles: ['4'] },
    ]);
  });

  it("are not in the way of somebody else's command, or of one that another came after", () => {
    expect(objectionsTo(goTo(), [goTo()], 'ben')).toEqual([]);
    const later = goTo({ number: 2, action: 'land', by: 'ben', vehicles: [{ vehicle: '1', state: 'waiting' }] });
    expect(objectionsTo(goTo(), [goTo(), later], 'me')).toEqual([]);
    const elsewhere = goTo({ number: 2, vehicles: [{ vehicle: '9', state: 'waiting' }] });
    expect(objectionsTo(goTo(), [goTo(), elsewhere], 'me')).toHaveLength(1);
  });
});
