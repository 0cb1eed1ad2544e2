import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { describe, expect, it, vi } from 'vitest';
import { copter, TestStation } from '../testing/station';
import Drawer from './Drawer.svelte';

function show(station: TestStation, selected: string[]) {
  const onclose = vi.fn();
  render(Drawer, { props: { selected, tool: 'none', target: undefined, onclose }, context: station.context });
  return onclose;
}

describe('the drawer', () => {
  it('tells of one vehicle its state, its charts and its details, and has its commands', async () => {
    const link = { name: 'a', messages_per_s: 20, bytes_per_s: 1, alive: true, used: true, loss: 0.02 };
    const station = TestStation.live([
      copter('1', {
        gps: { fix: 'RTK fixed', satellites: 14 },
        relative_alt_m: 21,
        links: [link],
        mission: { current: 3, total: 9, complete: false },
      }),
      copter('2'),
    ]);
    const onclose = show(station, ['1']);
    expect(screen.getByRole('heading', { name: 'copter 1' })).toBeVisible();
    expect(screen.getByText(/item 3\/9/)).toBeVisible();
    expect(screen.getByText(/RTK fixed, 14 satellites/)).toBeVisible();
    expect(screen.getByRole('button', { name: 'Hold' })).toBeVisible();
    expect(screen.getByRole('img', { name: /^Height, the last/ }).closest('figure')).toHaveTextContent('21 m');
    expect(screen.getByRole('img', { name: /^Link, the last/ }).closest('figure')).toHaveTextContent('98 %');
    await userEvent.click(screen.getByRole('button', { name: 'Clear the selection' }));
    expect(onclose).toHaveBeenCalledTimes(1);
  });

  it('draws what it has seen, a point a second', () => {
    const station = TestStation.live([copter('1', { relative_alt_m: 5 })]);
    show(station, ['1']);
    const points = () =>
      screen
        .getByRole('img', { name: /^Height/ })
        .querySelectorAll('path')[1]!
        .getAttribute('d')!
        .split(/[ML]/).length - 1;
    const begun = points();
    const now = performance.now();
    for (let second = 1; second <= 5; ++second) {
      station.tell({ type: 'vehicles', time_s: 100 + second, full: false, vehicles: [{ id: '1', relative_alt_m: 5 + second }] });
      station.stores.history.ticked(now + second * 2000);
    }
    station.tell();
    expect(points() - begun).toBe(5);
  });

  it('sums several up, and commands them together', async () => {
    const station = TestStation.live([copter('1'), copter('2'), copter('3', { family: 'rover' })]);
    show(station, ['1', '2', '3']);
    expect(screen.getByRole('heading', { name: '3 vehicles' })).toBeVisible();
    expect(screen.getByText('2 copters, 1 rover')).toBeVisible();
    await userEvent.click(screen.getByRole('button', { name: 'Hold' }));
    expect(station.asked).toEqual([{ type: 'command', action: 'hold', vehicles: ['1', '2', '3'], take_over: false }]);
  });

  it('has no commands for who may only look', () => {
    show(TestStation.live([copter('1')], { operator: '' }), ['1']);
    expect(screen.queryByRole('button', { name: 'Hold' })).toBeNull();
    expect(screen.getByRole('heading', { name: 'copter 1' })).toBeVisible();
  });
});
