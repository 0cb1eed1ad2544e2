import { render, screen, within } from '@testing-library/svelte';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { ServerMessage } from '../lib/protocol';
import { TestStation } from '../testing/station';
import HealthPanel from './HealthPanel.svelte';

let station: TestStation;

beforeEach(() => {
  const feeds = [
    { name: 'vehicles', id: 1 },
    { name: 'health', id: 2 },
  ];
  station = TestStation.live([{ id: 'robot1', name: 'robot 1', family: 'robot', connection: 'ok' }], { feeds });
});
afterEach(() => station.end());

const module = (short: string, name: string, more: object = {}) => ({
  module: short,
  name,
  required: true,
  state: 'ready',
  memory_bytes: 212e6,
  cpu_share: 0.31,
  rate_hz: 10,
  age_s: 0.1,
  ...more,
});
const lost = { code: 302, severity: 'critical', meaning: 'The place is lost.', what_to_do: 'Carry it back.' };
const stopped = { may_move: false, who: 'MMU', reason: 'mapping (MMU) reports error 302', what_to_do: 'Carry it back.' };

let revision = 0;
function tell(more: object, modules: object[]): void {
  const vehicles = [{ id: 'robot1', name: 'robot 1', may_move: true, needs_restart: false, ...more, modules }];
  station.tell({ type: 'health', feed: 'health', revision: ++revision, whole: true, vehicles } as unknown as ServerMessage);
}
const show = () => render(HealthPanel, { context: station.context });

it('asks for the feed and shows each module', () => {
  show();
  expect(screen.getByText(/No vehicle tells of its modules/)).toBeVisible();
  expect(station.subscribed).toContain('health');
  tell({}, [module('SIM', 'sensors'), module('CAR', 'carrier', { memory_bytes: undefined, cpu_share: undefined })]);
  expect(screen.getByRole('heading', { name: 'robot 1' })).toBeVisible();
  const [, sensors, carrier] = screen.getAllByRole('row');
  const cellsOf = (row: HTMLElement | undefined) =>
    within(row!)
      .getAllByRole('cell')
      .map((cell) => cell.textContent);
  expect(sensors).toHaveTextContent(/^SIM sensors/);
  expect(cellsOf(sensors)).toEqual(['✓ well', '', '212 MB', '31 %', '10 /s', '0.1 s']);
  expect(cellsOf(carrier)).toEqual(['✓ well', '', '–', '–', '10 /s', '0.1 s']);
  expect(screen.queryByRole('button')).toBeNull();
});

it('puts who needs somebody first and says what to do', () => {
  show();
  tell(stopped, [module('SIM', 'sensors'), module('MMU', 'mapping', { error: lost })]);
  const [, first] = screen.getAllByRole('row');
  expect(within(first!).getByText(/critical/)).toBeVisible();
  expect(first).toHaveTextContent('302 The place is lost. Carry it back.');
  expect(screen.getByText(/stands: mapping \(MMU\) reports error 302/)).toBeVisible();
});

it('is announced when a vehicle stops', () => {
  show();
  tell({}, [module('MMU', 'mapping')]);
  expect(station.stores.session.alert).not.toMatch(/stops/);
  tell(stopped, [module('MMU', 'mapping', { error: lost })]);
  expect(station.stores.session.alert).toBe('robot 1 stops: mapping (MMU) reports error 302.');
});

it('restarts a vehicle that was killed when the button is held, and tells why not', async () => {
  vi.useFakeTimers();
  show();
  tell({ may_move: false, needs_restart: true, reason: 'the robot was killed' }, [module('SIM', 'sensors')]);
  const button = screen.getByRole('button', { name: 'Restart' });
  button.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true }));
  expect(station.asked).toEqual([]);
  vi.advanceTimersByTime(800);
  expect(station.asked).toEqual([{ type: 'command', action: 'arm', vehicles: ['robot1'], take_over: false }]);
  vi.useRealTimers();
  const refused = { vehicle: 'robot1', state: 'refused' as const, reason: 'planner (PLN) has been silent for 0.4 s' };
  station.tell({
    type: 'commands',
    commands: [{ number: 1, action: 'arm', by: 'operator 1', asked: '2026-05-01T12:00:00Z', vehicles: [refused] }],
  });
  expect(await screen.findByText(/planner \(PLN\) has been silent/)).toBeVisible();
});

it('takes no restart while the emergency stop is latched', () => {
  show();
  tell({ may_move: false, needs_restart: true, reason: 'the robot was killed' }, [module('SIM', 'sensors')]);
  station.tell({ type: 'emergency', latched: true, action: 'hold', by: 'operator 2', vehicles: [] });
  expect(screen.getByRole('button', { name: 'Restart' })).toBeDisabled();
});
