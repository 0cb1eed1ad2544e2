import { describe, expect, it } from 'vitest';
import { groupAlarms, knownAlarms, newAlarms, tabTitle } from './alarms';
import { Announcer, REPEAT_MS } from './announcer';
import type { Alarm, Severity } from './protocol';

let numbers = 0;
const alarm = (vehicle: string, kind = 'silent', more: Partial<Alarm> = {}): Alarm => ({
  number: ++numbers,
  kind,
  severity: 'critical',
  vehicle,
  text: `copter ${vehicle} ${kind}`,
  raised: '2026-01-01T00:00:00Z',
  age_s: 3,
  ...more,
});
const grouped = (alarms: Alarm[]) => groupAlarms(knownAlarms(alarms, 10_000), (id) => `copter ${id}`);

describe('alarms', () => {
  it('tell 250 silent vehicles as one, as old as the oldest', () => {
    const fleet = Array.from({ length: 250 }, (_, i) => alarm(String(i + 1), 'silent', { age_s: 3 + i / 1000 }));
    const [group, ...others] = grouped(fleet);
    expect(others).toEqual([]);
    expect(group).toMatchObject({ title: '250 vehicles silent', names: 'copter 1, copter 2, copter 3 and 247 more' });
    expect(group?.numbers).toHaveLength(250);
    expect(group?.since).toBeCloseTo(10_000 - 3249);
  });
  it('tell one in its own words', () => {
    expect(grouped([alarm('7', 'fence', { text: 'copter 7 fence breached: boundary' })])).toMatchObject([
      { title: 'copter 7 fence breached: boundary', names: '', since: undefined },
    ]);
  });
  it('put what nobody has acknowledged first, and the critical before the rest', () => {
    const keys = grouped([
      alarm('1', 'lost', { acknowledged_by: 'operator 1' }),
      alarm('2', 'battery_low', { severity: 'warning' }),
      alarm('3', 'fence'),
      alarm('4', 'lost'),
    ]).map(({ kind, acknowledgedBy }) => `${kind} ${acknowledgedBy}`.trim());
    expect(keys).toEqual(['lost', 'fence', 'battery_low', 'lost operator 1']);
  });
  it('know kinds that they have no words for', () => {
    expect(grouped([alarm('1', 'gremlins'), alarm('2', 'gremlins')])).toMatchObject([{ title: '2 vehicles: gremlins' }]);
  });
  it('are new once, and not when they were acknowledged before they came', () => {
    const [known, fresh, seen] = [alarm('1'), alarm('2'), alarm('3', 'silent', { acknowledged_by: 'operator 2' })];
    expect(newAlarms([known], [known, fresh, seen])).toEqual([fresh]);
  });
  it('show in the title of the tab, with what is worse before them', () => {
    expect(tabTitle({ isLost: false, isLatched: false, alarms: 0 })).toBe('Lapwing');
    expect(tabTitle({ isLost: false, isLatched: false, alarms: 1 })).toBe('▲ 1 alarm · Lapwing');
    expect(tabTitle({ isLost: false, isLatched: true, alarms: 2 })).toBe('■ E-STOP · ▲ 2 alarms · Lapwing');
    expect(tabTitle({ isLost: true, isLatched: true, alarms: 0 })).toBe('✖ Station lost · Lapwing');
  });
});

describe('the announcer', () => {
  const heard = (sound: boolean, voice: boolean) => {
    const sounds: string[] = [];
    const voices = {
      beep: (severity: Severity) => sounds.push(severity),
      speak: (text: string) => sounds.push(text),
      wake: () => {},
      isMuted: false,
    };
    return { sounds, announcer: new Announcer(voices, () => ({ sound, voice })) };
  };
  it('says nothing unless it is asked to', () => {
    const { sounds, announcer } = heard(false, false);
    announcer.tell('critical', 'copter 1 silent', 0);
    announcer.remind('critical', REPEAT_MS);
    expect(sounds).toEqual([]);
  });
  it('sounds and speaks by choice', () => {
    const { sounds, announcer } = heard(true, true);
    announcer.tell('warning', 'copter 1 battery low', 0);
    expect(sounds).toEqual(['warning', 'copter 1 battery low']);
  });
  it('sounds again for what is critical until it is acknowledged', () => {
    const { sounds, announcer } = heard(true, false);
    announcer.tell('critical', 'copter 1 silent', 0);
    announcer.remind('critical', REPEAT_MS - 1);
    announcer.remind('critical', REPEAT_MS);
    announcer.remind('critical', REPEAT_MS + 1);
    announcer.remind('warning', 3 * REPEAT_MS);
    announcer.remind(undefined, 4 * REPEAT_MS);
    expect(sounds).toEqual(['critical', 'critical']);
  });
});
