import { expect, it } from 'vitest';
import { byNeed, conditionOf, healthOf, inNeed, memoryText, type Module, type VehicleHealth } from './health';

const well = (module: string, more: Partial<Module> = {}): Module => ({ module, name: module, required: true, state: 'ready', ...more });
const degraded = { code: 103, severity: 'degraded', meaning: 'A sonar is stuck.', what_to_do: 'Clean it.' } as const;
const robot = (id: string, modules: Module[], more: Partial<VehicleHealth> = {}): VehicleHealth => ({
  id,
  name: id,
  may_move: true,
  needs_restart: false,
  modules,
  ...more,
});

it('reads what is told and leaves out what cannot be', () => {
  const told = robot('robot1', [well('SIM', { age_s: 0.1, rate_hz: 10, error: degraded })]);
  expect(healthOf({ type: 'health', vehicles: [told] })).toEqual([told]);
  const broken = { ...told, modules: [{ module: 'SIM' }, null, well('CAR', { age_s: Infinity, memory_bytes: -1 })] };
  expect(healthOf({ vehicles: [broken, { id: 'robot2' }, 7, told] })).toEqual([robot('robot1', [well('CAR')])]);
  expect(healthOf(undefined)).toEqual([]);
  expect(healthOf({ vehicles: 'none' })).toEqual([]);
});

it('takes an error of a severity that it does not know for a critical one', () => {
  const [read] = healthOf({ vehicles: [robot('robot1', [well('SIM', { error: { ...degraded, severity: 'dire' as 'critical' } })])] });
  expect(read?.modules[0]?.error?.severity).toBe('critical');
});

it('says how a module is', () => {
  const wordOf = (more: Partial<Module>): string => conditionOf(well('SIM', more)).word;
  expect(wordOf({})).toBe('well');
  expect(wordOf({ state: 'silent', error: degraded })).toBe('silent');
  expect(wordOf({ state: 'unheard' })).toBe('not started');
  expect(wordOf({ error: degraded })).toBe('degraded');
  expect(wordOf({ error: { ...degraded, severity: 'notice' } })).toBe('notice');
  expect(conditionOf(well('CM', { state: 'silent', required: false })).level).toBe('lost');
  expect(conditionOf(well('MMU', { state: 'silent' })).level).toBe('critical');
});

it('puts those first that need somebody', () => {
  const fine = robot('robot1', [well('SIM'), well('CAR')]);
  const limps = robot('robot2', [well('SIM'), well('CAR', { error: degraded }), well('MMU', { state: 'silent', required: false })]);
  const stands = robot('robot3', [well('SIM'), well('MMU', { state: 'silent' })], { may_move: false });
  const killed = robot('robot4', [well('SIM')], { may_move: false, needs_restart: true });
  const sorted = byNeed([fine, limps, killed, stands]);
  expect(sorted.map(({ id }) => id)).toEqual(['robot3', 'robot4', 'robot2', 'robot1']);
  expect(sorted[2]?.modules.map(({ module }) => module)).toEqual(['CAR', 'MMU', 'SIM']);
  expect(inNeed([fine, limps, killed, stands])).toBe(3);
});

it('tells memory in megabytes', () => {
  expect([memoryText(undefined), memoryText(2_340_000), memoryText(212_000_000)]).toEqual(['–', '2.3 MB', '212 MB']);
});
