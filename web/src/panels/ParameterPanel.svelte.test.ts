import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it } from 'vitest';
import { copter, TestStation } from '../testing/station';
import ParameterPanel from './ParameterPanel.svelte';

const list = {
  vehicle: '1',
  confirmed: 'vehicle',
  taken: '2026-05-01T12:00:00Z',
  parameters: [
    { name: 'RTL_ALT', value: 1500, type: 'int32' },
    { name: 'WPNAV_SPEED', value: 1000, type: 'real32' },
  ],
};

function show(): TestStation {
  const station = TestStation.live([copter('1')]);
  station.files.set('/api/v1/parameters', Response.json(list));
  render(ParameterPanel, { props: { vehicle: station.stores.fleet.get('1') }, context: station.context });
  return station;
}

it('fetches when it is asked to, and finds by name', async () => {
  const user = userEvent.setup();
  show();
  expect(screen.queryByRole('table')).toBeNull();
  await user.click(screen.getByRole('button', { name: 'Fetch parameters' }));
  expect(await screen.findByText('2 parameters fetched.')).toBeVisible();
  await user.type(screen.getByLabelText('Filter by name'), 'rtl');
  expect(screen.getByRole('rowheader')).toHaveTextContent('RTL_ALT');
});

it('refuses what is no value of the parameter, and tells what the vehicle holds after a change', async () => {
  const user = userEvent.setup();
  const station = show();
  await user.click(screen.getByRole('button', { name: 'Fetch parameters' }));
  await user.click(await screen.findByRole('button', { name: /Change RTL_ALT/ }));
  const value = screen.getByLabelText('New value of RTL_ALT');
  await user.clear(value);
  await user.type(value, '0.5{Enter}');
  expect(screen.getByRole('alert')).toHaveTextContent('This parameter is an integer.');
  station.files.set('/api/v1/parameters/value', Response.json({ name: 'RTL_ALT', value: 2000, type: 'int32', before: 1500 }));
  await user.clear(value);
  await user.type(value, '2000{Enter}');
  expect(await screen.findByText('RTL_ALT is 2000 now, was 1500.')).toBeVisible();
  expect(screen.getByRole('button', { name: 'Change RTL_ALT, now 2000' })).toBeVisible();
});

it('says so when the station does not answer', async () => {
  const station = show();
  station.files.clear();
  await userEvent.click(screen.getByRole('button', { name: 'Fetch parameters' }));
  expect(await screen.findByText('The station did not answer.')).toBeVisible();
});
