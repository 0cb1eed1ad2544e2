import { fireEvent, render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Command } from '../lib/protocol';
import { copter, TestStation } from '../testing/station';
import CommandTable from './CommandTable.svelte';

const refused: Command = {
  number: 7,
  action: 'go_to',
  by: 'operator 1',
  asked: '2026-05-01T12:00:00Z',
  height_m: 40,
  place: { lat_deg: 41.25, lon_deg: -8.6, alt_m: 0 },
  allow: { ceiling: 'permission of the tower' },
  vehicles: [
    { vehicle: '1', state: 'refused', reason: 'the place is 12 km away [too_far]', rule: 'too_far' },
    { vehicle: '2', state: 'under_way' },
  ],
};
let station: TestStation;
beforeEach(() => {
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  station = TestStation.live([copter('1'), copter('2')]);
  render(CommandTable, { context: station.context });
  station.tell({ type: 'commands', commands: [refused] });
});
afterEach(() => vi.useRealTimers());

const user = userEvent.setup({ delay: null });
const offer = (): HTMLElement => screen.getByRole('button', { name: 'Do it anyway…' });
const reason = (): HTMLElement => screen.getByLabelText('Why it is meant');
const goAnyway = (): HTMLElement => screen.getByRole('button', { name: /Go to anyway/ });
async function hold(button: HTMLElement): Promise<void> {
  await fireEvent.keyDown(button, { key: 'Enter' });
  await vi.advanceTimersByTimeAsync(1000);
}

describe('a command that a rule refused', () => {
  it('is given once more with a reason, for the vehicles that were refused, and with what was allowed before', async () => {
    await user.click(offer());
    expect(screen.getByRole('group', { name: 'Do it anyway' })).toHaveTextContent(/Rule too_far .*: a place is far away.* for copter 1,/);
    expect(reason()).toHaveFocus();
    expect(goAnyway()).toBeDisabled();
    await user.type(reason(), ' why  ');
    expect(goAnyway()).toBeDisabled();
    await user.clear(reason());
    await user.type(reason(), 'search area B');
    await fireEvent.keyDown(goAnyway(), { key: 'Enter' });
    await fireEvent.keyUp(goAnyway(), { key: 'Enter' });
    expect(station.asked).toEqual([]);
    await hold(goAnyway());
    expect(station.asked).toEqual([
      {
        type: 'command',
        action: 'go_to',
        vehicles: ['1'],
        lat_deg: 41.25,
        lon_deg: -8.6,
        height_m: 40,
        allow: { ceiling: 'permission of the tower', too_far: 'search area B' },
        take_over: false,
      },
    ]);
    expect(screen.queryByLabelText('Why it is meant')).toBeNull();
  });

  it('is left with Escape or Cancel, without a word to the station', async () => {
    for (const leave of [() => user.keyboard('{Escape}'), () => user.click(screen.getByRole('button', { name: 'Cancel' }))]) {
      await user.click(offer());
      await user.type(reason(), 'search area B');
      await leave();
      expect(offer()).toHaveFocus();
    }
    expect(station.asked).toEqual([]);
  });

  it('stays open to be explained while others are commanded, and goes when its vehicle is', async () => {
    await user.click(offer());
    await user.type(reason(), 'search');
    const other: Command = { ...refused, number: 8, by: 'operator 2', vehicles: [{ vehicle: '2', state: 'confirmed' }] };
    station.tell({ type: 'commands', commands: [refused, other] });
    expect(reason()).toHaveValue('search');
    expect((reason().closest('details') as HTMLDetailsElement).open).toBe(true);
    const land: Command = { ...refused, number: 9, action: 'land', vehicles: [{ vehicle: '1', state: 'waiting' }] };
    station.tell({ type: 'commands', commands: [refused, other, land] });
    expect(screen.queryByLabelText('Why it is meant')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Do it anyway…' })).toBeNull();
  });

  it('says whom it takes the vehicle from', async () => {
    station.tell({ type: 'vehicles', time_s: 101, full: true, vehicles: [copter('1', { control: { commander: 'script' } })] });
    await user.click(offer());
    await user.type(reason(), 'search area B');
    expect(goAnyway()).toHaveTextContent('Take over: Go to anyway');
    await hold(goAnyway());
    expect(station.asked[0]).toMatchObject({ take_over: true });
  });

  it('is not done anyway in an emergency stop', async () => {
    await user.click(offer());
    await user.type(reason(), 'search area B');
    station.tell({ type: 'emergency', latched: true, action: 'hold', by: 'operator 2', vehicles: [] });
    expect(goAnyway()).toBeDisabled();
  });

  it('tells in its line what was allowed, and why', () => {
    expect(screen.getByRole('caption')).toHaveTextContent('ceiling allowed: permission of the tower');
  });
});
