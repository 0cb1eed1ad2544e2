import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { objectionsTo, ruleOf, RULES } from './plausibility';
import type { Command } from './protocol';

const REFUSED = 'the place is 12 km away; 5.0 km is the limit [too_far]';
const goTo = (rest: Partial<Command> = {}): Command => ({
  number: 1,
  action: 'go_to',
  by: 'me',
  asked: '',
  vehicles: [{ vehicle: '1', state: 'refused', reason: REFUSED }],
  ...rest,
});

describe('rules of plausibility', () => {
  it('are those of the reference', () => {
    const table = readFileSync('../docs/reference/plausibility.md', 'utf8').split('## Rules')[1]!.split('\n## ')[0]!;
    expect([...RULES.keys()]).toEqual([...table.matchAll(/^\| `(\w+)` \|/gm)].map(([, rule]) => rule));
  });

  it('are named at the end of a refusal, and nowhere else', () => {
    expect(ruleOf(REFUSED)).toBe('too_far');
    expect(ruleOf('arming refused: Arm: Throttle too high')).toBeUndefined();
    expect(ruleOf('[too_far] of what')).toBeUndefined();
    expect(ruleOf('PreArm: check [battery2]')).toBeUndefined();
    expect(ruleOf(undefined)).toBeUndefined();
  });

  it('stand against the vehicles that were refused by them', () => {
    const vehicles: Command['vehicles'] = [
      { vehicle: '1', state: 'refused', reason: REFUSED },
      { vehicle: '2', state: 'under_way', reason: REFUSED },
      { vehicle: '3', state: 'refused', reason: REFUSED },
      { vehicle: '4', state: 'refused', reason: 'it would end in the ground [below_ground]' },
      { vehicle: '5', state: 'refused', reason: 'vehicle 5 is commanded by ben' },
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
