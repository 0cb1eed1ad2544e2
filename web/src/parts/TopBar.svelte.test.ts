import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it, vi } from 'vitest';
import { TestStation } from '../testing/station';
import TokenDialog from './TokenDialog.svelte';
import TopBar from './TopBar.svelte';

const props = { onhelp: vi.fn(), onsettings: vi.fn(), onemergency: vi.fn() };

it('stops the script and everything', async () => {
  const station = TestStation.live();
  station.tell({ type: 'script', name: 'a/b.dolphin', state: 'running', message: '', source: '', diagnostics: [] });
  render(TopBar, { props, context: station.context });
  expect(screen.getByText('b.dolphin')).toBeVisible();
  await userEvent.click(screen.getByRole('button', { name: 'STOP' }));
  expect(screen.getByRole('button', { name: 'STOPPING' })).toBeVisible();
  expect(station.asked).toEqual([{ type: 'stop_script' }]);
  await userEvent.click(screen.getByRole('button', { name: 'E-STOP' }));
  expect(props.onemergency).toHaveBeenCalledTimes(1);
});

it('says that E-STOP reaches nobody when the station is lost', () => {
  const station = TestStation.live();
  render(TopBar, { props, context: station.context });
  station.goAway();
  expect(screen.getByRole('banner')).toHaveTextContent('station lost');
  expect(screen.getByRole('button', { name: 'E-STOP, which does not reach the station now' })).toBeVisible();
  station.end();
});

it('has no E-STOP where vehicles cannot be commanded', () => {
  const station = TestStation.live([], { operator: '' });
  render(TopBar, { props, context: station.context });
  expect(screen.queryByRole('button', { name: 'E-STOP' })).toBeNull();
});

it('changes the colours, and keeps them', async () => {
  const station = TestStation.live();
  render(TopBar, { props, context: station.context });
  await userEvent.click(screen.getByRole('button', { name: 'Colours: system. Change' }));
  expect(screen.getByRole('button', { name: 'Colours: light. Change' })).toBeVisible();
  expect(localStorage.getItem('lapwing.theme')).toBe('light');
});

it('asks for the token of a station that is locked', async () => {
  const station = TestStation.live();
  station.files.set('/api/v1/status', new Response('', { status: 401 }));
  render(TokenDialog, { context: station.context });
  station.goAway();
  await vi.waitFor(() => expect(station.stores.session.phase).toBe('locked'));
  await userEvent.type(screen.getByLabelText('Token'), 'http://127.0.0.1:8080/#token=0123456789abcdef');
  await userEvent.click(screen.getByRole('button', { name: 'Connect' }));
  expect(station.stores.session.hasToken).toBe(true);
  station.end();
});
