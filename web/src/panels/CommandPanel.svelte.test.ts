import { fireEvent, render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Command } from '../lib/protocol';
import { copter, TestStation } from '../testing/station';
import CommandPanel from './CommandPanel.svelte';

let station: TestStation;
beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  station = TestStation.live([copter('1'), copter('2', { control: { commander: 'operator 2' } })]);
});
afterEach(() => vi.useRealTimers());

function show(selected: string[]): void {
  render(CommandPanel, { props: { selected, tool: 'none', target: undefined }, context: station.context });
}
const button = (name: string | RegExp): HTMLElement => screen.getByRole('button', { name });
async function hold(name: string): Promise<void> {
  await fireEvent.keyDown(button(name), { key: 'Enter' });
  await vi.advanceTimersByTimeAsync(1000);
}

describe('the command panel', () => {
  it('stops at once, and arms only after a hold', async () => {
    show(['1']);
    await fireEvent.click(button('Hold'));
    expect(station.asked).toEqual([{ type: 'command', action: 'hold', vehicles: ['1'], take_over: false }]);
    await fireEvent.keyDown(button('Arm'), { key: 'Enter' });
    await fireEvent.keyUp(button('Arm'), { key: 'Enter' });
    expect(station.asked).toHaveLength(1);
    await hold('Arm');
    expect(station.asked[1]).toEqual({ type: 'command', action: 'arm', vehicles: ['1'], take_over: false });
  });

  it('says whom it takes a vehicle from, and takes it', async () => {
    show(['2']);
    expect(screen.getByText('operator 2')).toBeVisible();
    await hold('Take over: Arm');
    expect(station.asked).toEqual([{ type: 'command', action: 'arm', vehicles: ['2'], take_over: true }]);
  });

  it('takes off to the height that is given, and to none that is none', async () => {
    const user = userEvent.setup({ delay: null });
    show(['1']);
    const height = screen.getByLabelText(/Height to take off to/);
    await user.clear(height);
    expect(button('Take off')).toBeDisabled();
    await user.type(height, '25');
    await hold('Take off');
    expect(station.asked).toEqual([{ type: 'command', action: 'take_off', vehicles: ['1'], height_m: 25, take_over: false }]);
  });

  it('offers what one of the vehicles can do', () => {
    const flies = ['Land', 'Take off'];
    const missions = ['Start mission', 'Pause', 'Resume'];
    const offered = (): string[] => [...flies, ...missions].filter((name) => screen.queryByRole('button', { name }));
    const wanted = { robot: [], rover: missions, copter: [...flies, ...missions] };
    for (const family of ['robot', 'rover', 'copter'] as const) {
      station = TestStation.live([copter('1', { family }), copter('2', { family: 'robot' })]);
      const { unmount } = render(CommandPanel, {
        props: { selected: ['1', '2'], tool: 'none', target: undefined },
        context: station.context,
      });
      expect(offered(), family).toEqual(wanted[family]);
      for (const name of ['Hold', 'Return', 'Disarm', 'Arm', 'Go to…']) expect(button(name)).toBeVisible();
      unmount();
    }
  });

  it('says why a command was refused', async () => {
    show(['1']);
    await fireEvent.click(button('Land'));
    await station.reply({ ok: false, error: { message: 'Vehicle 1 is far away.', hint: 'Bring it nearer.' } });
    expect(await screen.findByRole('alert')).toHaveTextContent('Vehicle 1 is far away. Bring it nearer.');
    expect(station.stores.session.alert).toBe('Vehicle 1 is far away. Bring it nearer.');
  });

  it('lets nothing move in an emergency stop, and lets it land', () => {
    show(['1']);
    station.tell({ type: 'emergency', latched: true, action: 'hold', by: 'operator 2', vehicles: [] });
    expect(button('Arm')).toBeDisabled();
    expect(button('Go to…')).toBeDisabled();
    expect(button('Land')).toBeEnabled();
  });

  it('tells in a line what became of the last command, and of each vehicle below', () => {
    show(['1']);
    const command: Command = {
      number: 1,
      action: 'take_off',
      by: 'operator 1',
      asked: '2026-05-01T12:00:00Z',
      height_m: 15,
      vehicles: [{ vehicle: '1', state: 'under_way' }],
    };
    station.tell({ type: 'commands', commands: [command] });
    expect(screen.getByTitle('Take off, 15 m: under way')).toBeVisible();
    station.tell({ type: 'commands', commands: [{ ...command, vehicles: [{ vehicle: '1', state: 'refused', reason: 'not armed' }] }] });
    expect(screen.getByTitle('Take off, 15 m: refused, not armed')).toBeVisible();
    expect(screen.getByRole('row', { name: /copter 1/ })).toHaveTextContent(/✖ refused.*not armed/);
  });
});
