import { fireEvent, render, screen, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { ServerMessage } from '../lib/protocol';
import { TestStation } from '../testing/station';
import SurveyPanel from './SurveyPanel.svelte';

let station: TestStation;
const COMMANDS = '/api/v1/survey/hawk/commands';

beforeEach(() => {
  station = TestStation.live([], { feeds: [{ name: 'survey', id: 1 }] });
  station.files.set(COMMANDS, new Response('{}', { status: 202 }));
});
afterEach(() => {
  vi.useRealTimers();
  station.end();
});

let revision = 0;
function tell(more: object): void {
  const drones = [{ name: 'hawk', connected: true, words: [], state: 'Hover', armed: true, healthy: true, ...more }];
  station.tell({ type: 'survey', feed: 'survey', revision: ++revision, whole: true, drones } as unknown as ServerMessage);
}
const show = () => render(SurveyPanel, { context: station.context });
const button = (name: string) => screen.getByRole('button', { name });

/** Held long enough to count. */
async function hold(name: string): Promise<void> {
  vi.useFakeTimers();
  await fireEvent.keyDown(button(name), { key: 'Enter' });
  await vi.advanceTimersByTimeAsync(800);
  vi.useRealTimers();
}

async function fill(label: RegExp, text: string): Promise<void> {
  await userEvent.clear(screen.getByLabelText(label));
  await userEvent.type(screen.getByLabelText(label), text);
}

it('shows how the drone is and what it has found', () => {
  show();
  expect(station.subscribed).toContain('survey');
  const words = [{ at: '2026-05-01T12:00:00Z', text: 'it climbs' }];
  tell({ mode: 'GUIDED', height_m: 12.3, battery: 0.82, slots: { free: 3, taken: 4, unknown: 1 }, words });
  expect(screen.getByRole('heading', { name: 'hawk' })).toBeVisible();
  expect(screen.getByText('hovering', { exact: false })).toBeVisible();
  expect(screen.getByText('GUIDED, armed, 12 m high, battery 82 %')).toBeVisible();
  expect(screen.getByLabelText(/Places to park/)).toHaveTextContent(/free\s*3\s*taken\s*4\s*unknown\s*1/);
  expect(within(screen.getByRole('list')).getByText(/it climbs/)).toBeVisible();
});

it('lets it do only what it can do now', () => {
  show();
  tell({ state: 'Idle', armed: false });
  expect(button('Arm')).toBeEnabled();
  for (const name of ['Take off', 'Explore', 'Move in the lot', 'Disarm']) expect(button(name)).toBeDisabled();
  tell({ state: 'Arm', armed: false });
  expect(button('Take off')).toBeDisabled();
  tell({ state: 'Arm', armed: true });
  expect(button('Take off')).toBeEnabled();
  tell({});
  expect(button('Arm')).toBeDisabled();
  for (const name of ['Explore', 'Move in the lot', 'Move anyway', 'Come home']) expect(button(name)).toBeEnabled();
  tell({ connected: false, trouble: 'connection refused' });
  expect(screen.getByText(/not connected: connection refused/)).toBeVisible();
  for (const name of ['Explore', 'Come home']) expect(button(name)).toBeDisabled();
  expect(button('Kill')).toBeEnabled();
});

it('hands commands on as the drone reads them', async () => {
  show();
  tell({});
  await hold('Explore');
  expect(station.posted).toEqual([{ address: COMMANDS, body: { Type: 'Autonomous Explore' } }]);
  await fill(/^east/, '20');
  await fill(/^north/, '-10');
  await hold('Move anyway');
  expect(station.posted[1]?.body).toEqual({ Type: 'Compulsive Move', X: 20, Y: -10 });
  tell({ state: 'Idle' });
  await userEvent.click(button('Set heights'));
  expect(station.posted[2]?.body).toEqual({ Type: 'Configure', Min: 8, Des: 12, Max: 20 });
});

it('says why a command was not handed on', async () => {
  station.files.set(COMMANDS, new Response('{"detail":"hawk is not connected","hint":"connection refused"}', { status: 409 }));
  show();
  tell({});
  await userEvent.click(button('Come home'));
  expect(await screen.findByRole('alert')).toHaveTextContent('hawk is not connected. Connection refused.');
});
