import { render, screen, within } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { describe, expect, it, vi } from 'vitest';
import { copter, TestStation } from '../testing/station';
import VehicleTable from './VehicleTable.svelte';

const row = (name: string): HTMLElement => screen.getByRole('row', { name: new RegExp(name) });

function show(station: TestStation, selected: string[] = []) {
  const onselect = vi.fn();
  render(VehicleTable, { props: { selected, onselect }, context: station.context });
  return onselect;
}

describe('the vehicle table', () => {
  it('says that nobody has been heard yet', () => {
    show(TestStation.live());
    expect(screen.getByText(/No vehicle has been heard yet/)).toBeVisible();
  });

  it('tells of each vehicle what matters most, by word and sign', () => {
    const flying = { armed: true, landed: false, relative_alt_m: 20, mode: 'AUTO', mission: { current: 3, total: 9, complete: false } };
    show(TestStation.live([copter('1', flying), copter('2', { battery: { remaining: 0.2 } }), copter('3', { connection: 'lost' })]));
    expect(row('copter 1')).toHaveTextContent(/▶ in the air.*AUTO.*item 3\/9.*20 m/);
    expect(row('copter 2')).toHaveTextContent(/▲ battery low.*20 %/);
    expect(row('copter 3')).toHaveTextContent(/\? link lost.*last known/);
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

  it('selects with a click, and adds with Shift', async () => {
    const user = userEvent.setup();
    const onselect = show(TestStation.live([copter('1'), copter('2')]));
    await user.click(screen.getByRole('button', { name: /copter 1/ }));
    await user.keyboard('{Shift>}');
    await user.click(screen.getByRole('button', { name: /copter 2/ }));
    expect(onselect.mock.calls).toEqual([
      ['1', false],
      ['2', true],
    ]);
  });

  it('unfolds the details of the only one that is selected', () => {
    const station = TestStation.live([copter('1', { gps: { fix: 'RTK fixed', satellites: 14 } }), copter('2')]);
    show(station, ['1']);
    expect(within(screen.getByRole('table')).getByText(/RTK fixed, 14 satellites/)).toBeVisible();
  });
});
