import { expect, it } from 'vitest';
import type { VehicleFields } from './protocol';
import { statusOf } from './status';

const status = (fields: VehicleFields, stationLost = false) => statusOf({ id: '1', fields, heardAt: {} }, stationLost);

it.each<[VehicleFields, string, string]>([
  [{ connection: 'conflict', battery: { remaining: 0.01 } }, 'critical', 'id conflict'],
  [{ connection: 'lost', armed: true, silent: true }, 'lost', 'link lost'],
  [{ connection: 'ok', armed: true, landed: false, silent: true }, 'lost', 'silent'],
  [{ connection: 'ok', armed: true, battery: { remaining: 0.1 } }, 'critical', 'battery empty'],
  [{ armed: true, battery: { remaining: 0.2 } }, 'warning', 'battery low'],
  [{ armed: true, health: { position_ok: false, prearm_ok: true } }, 'warning', 'no position'],
  [{ armed: true, landed: false }, 'active', 'in the air'],
  [{ armed: true, landed: true }, 'active', 'armed'],
  [{ armed: false, health: { position_ok: true, prearm_ok: false } }, 'warning', 'not ready to arm'],
  [{ armed: false, health: { position_ok: true, prearm_ok: true } }, 'ready', 'disarmed'],
  [{}, 'ready', 'connected'],
])('%j is %s: %s', (fields, level, word) => {
  expect(status(fields)).toMatchObject({ level, word });
});

it('calls a battery low from where the station does', () => {
  const limits = { low: 0.5, critical: 0.4 };
  const word = (remaining: number) => statusOf({ id: '1', fields: { battery: { remaining } }, heardAt: {} }, false, limits).word;
  expect([word(0.6), word(0.45), word(0.39)]).toEqual(['connected', 'battery low', 'battery empty']);
});

it('trusts nothing when the station is lost', () => {
  expect(status({ connection: 'ok', armed: true }, true)).toMatchObject({ level: 'lost', word: 'old data' });
});

it('has a symbol of its own for each level', () => {
  const levels = [
    status({}),
    status({ armed: true }),
    status({ battery: { remaining: 0.2 } }),
    status({ connection: 'conflict' }),
    status({}, true),
  ];
  expect(new Set(levels.map((s) => s.symbol)).size).toBe(5);
});
