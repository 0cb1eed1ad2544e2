import { render, screen, within } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { flushSync } from 'svelte';
import { describe, expect, it, vi } from 'vitest';
import type { ServerMessage } from '../lib/protocol';
import { copter, TestStation } from '../testing/station';
import FleetStrip from './FleetStrip.svelte';

const row = (name: string): HTMLElement => screen.getByRole('option', { name: new RegExp(name) });
const names = (): (string | undefined)[] =>
  within(screen.getByRole('listbox'))
    .getAllByRole('option')
    .map((one) => /copter \d+/.exec(one.textContent)?.[0]);

function show(station: TestStation, selected: string[] = [], isRow = false) {
  const onselect = vi.fn();
  render(FleetStrip, { props: { selected, onselect, isRow }, context: station.context });
  return onselect;
}

describe('the list of vehicles', () => {
  it('says that nobody has been heard yet', () => {
    show(TestStation.live());
    expect(screen.getByText(/No vehicle has been heard yet/)).not.toHaveTextContent('Survey');
  });

  it('leads to survey drones where there is nobody else', () => {
    const station = TestStation.live([], { feeds: [{ name: 'survey', id: 1 }] });
    show(station);
    const told = { type: 'survey', feed: 'survey', revision: 1, whole: true, drones: [{ name: 'hawk', connected: true, words: [] }] };
    flushSync(() => station.tell(told as unknown as ServerMessage));
    expect(screen.getByText(/No vehicle has been heard yet/)).toHaveTextContent(/survey drones are in the tab Survey\.$/);
  });

  it('tells of each vehicle what matters most, by word and sign', () => {
    const battery = { remaining: 0.82, time_left_s: 1000, time_left_is_estimate: true };
    const flying = { armed: true, landed: false, relative_alt_m: 20, mode: 'AUTO', battery };
    show(TestStation.live([copter('1', flying), copter('2', { battery: { remaining: 0.2 } }), copter('3', { connection: 'lost' })]));
    expect(row('copter 1')).toHaveTextContent(/copter 1.*▶ in the air.*AUTO.*20 m.*82 %.*≈17′.*●/);
    expect(row('copter 2')).toHaveTextContent(/▲ battery low.*20 %/);
    expect(row('copter 3')).toHaveTextContent(/\? link lost.*last known.*○/);
  });

  it('has who needs attention first, and each in its place while somebody points at the list', async () => {
    const station = TestStation.live([copter('1'), copter('2'), copter('3', { connection: 'lost' })]);
    show(station);
    expect(names()).toEqual(['copter 3', 'copter 1', 'copter 2']);
    await userEvent.hover(row('copter 2'));
    station.tell({ type: 'vehicles', time_s: 101, full: false, vehicles: [{ id: '2', connection: 'conflict' }] });
    expect(names()).toEqual(['copter 3', 'copter 1', 'copter 2']);
    await userEvent.unhover(screen.getByRole('listbox'));
    expect(names()).toEqual(['copter 2', 'copter 3', 'copter 1']);
  });

  it('finds by words, and sorts and groups as it is told', async () => {
    const user = userEvent.setup({ delay: null });
    show(TestStation.live([copter('1'), copter('2', { family: 'rover' }), copter('3', { connection: 'lost' })]));
    await user.selectOptions(screen.getByLabelText('Order'), 'By number');
    expect(names()).toEqual(['copter 1', 'copter 2', 'copter 3']);
    await user.selectOptions(screen.getByLabelText('Groups'), 'By kind');
    expect(screen.getByText('Rover')).toBeVisible();
    await user.type(screen.getByRole('searchbox'), 'lost');
    expect(names()).toEqual(['copter 3']);
    await user.type(screen.getByRole('searchbox'), ' nobody');
    expect(screen.getByText('No vehicle is like that.')).toBeVisible();
    expect(localStorage.getItem('lapwing.fleet.grouping')).toBe('kind');
  });

  it('has of 250 vehicles only those in the page that are in sight', () => {
    show(TestStation.live(Array.from({ length: 250 }, (_, index) => copter(String(index + 1)))));
    expect(screen.getAllByRole('option').length).toBeLessThan(30);
    expect(row('copter 1 ')).toHaveAttribute('aria-setsize', '250');
  });

  it('follows what the station tells of one, and leaves the others', () => {
    const station = TestStation.live([copter('1'), copter('2')]);
    show(station);
    station.tell({ type: 'vehicles', time_s: 101, full: false, vehicles: [{ id: '2', mode: 'RTL' }] });
    expect(row('copter 2')).toHaveTextContent('RTL');
    expect(row('copter 1')).toHaveTextContent('GUIDED');
  });

  it('shows all of it as old when the station is lost', () => {
    const station = TestStation.live([copter('1')]);
    show(station);
    station.goAway();
    expect(row('copter 1')).toHaveTextContent('? old data');
    station.end();
  });

  it('selects with a click, and adds with Shift or a long press', async () => {
    const user = userEvent.setup();
    const onselect = show(TestStation.live([copter('1'), copter('2')]), ['1']);
    expect(row('copter 1')).toHaveAttribute('aria-selected', 'true');
    await user.click(row('copter 1'));
    await user.keyboard('{Shift>}');
    await user.click(row('copter 2'));
    await user.keyboard('{/Shift}');
    await user.pointer({ keys: '[MouseRight]', target: row('copter 2') });
    expect(onselect.mock.calls).toEqual([
      ['1', false],
      ['2', true],
      ['2', true],
    ]);
  });

  it('is gone along and selected from by keyboard, as one stop of Tab', async () => {
    const user = userEvent.setup();
    const onselect = show(TestStation.live([copter('1'), copter('2'), copter('3')]));
    screen.getByRole('listbox').focus();
    await user.keyboard('{ArrowDown}{ArrowDown}{Enter}{Home}{Shift>} {/Shift}{End}{ArrowDown}');
    expect(onselect.mock.calls).toEqual([
      ['3', false],
      ['1', true],
    ]);
    const active = screen.getByRole('listbox').getAttribute('aria-activedescendant');
    expect(document.getElementById(active ?? '')).toBe(row('copter 3'));
  });

  it('lies side by side on a narrow screen, with the search behind a button', async () => {
    show(TestStation.live([copter('1', { battery: { remaining: 0.5 } })]), [], true);
    expect(screen.queryByRole('searchbox')).toBeNull();
    await userEvent.click(screen.getByRole('button', { name: 'Search and sort' }));
    expect(screen.getByRole('searchbox')).toBeVisible();
    expect(within(row('copter 1')).getByText('50 %')).toBeVisible();
  });
});
