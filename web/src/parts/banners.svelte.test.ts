import { fireEvent, render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Alarm, Emergency } from '../lib/protocol';
import { copter, TestStation } from '../testing/station';
import AlarmBanner from './AlarmBanner.svelte';
import EmergencyBanner from './EmergencyBanner.svelte';
import LostBanner from './LostBanner.svelte';
import RequestBanner from './RequestBanner.svelte';
import StopNotice from './StopNotice.svelte';

afterEach(() => vi.useRealTimers());

describe('the alarm banner', () => {
  const silent = (number: number): Alarm => ({ number, kind: 'silent', severity: 'critical', vehicle: String(number), text: `copter ${number} silent`, raised: '', age_s: 3 }); // prettier-ignore

  it('tells of one by its words and of many as one, and acknowledges them', async () => {
    const station = TestStation.live([copter('1')]);
    const onselect = vi.fn();
    render(AlarmBanner, { props: { onselect }, context: station.context });
    expect(screen.queryByRole('region')).toBeNull();
    station.tell({ type: 'alarms', alarms: [silent(1)] });
    expect(screen.getByRole('alert')).toHaveTextContent('Alarm: copter 1 silent');
    station.tell({ type: 'alarms', alarms: Array.from({ length: 250 }, (_, index) => silent(index + 1)) });
    expect(screen.getByRole('alert')).toHaveTextContent(/250 vehicles silent.*copter 1, 2, 3 and 247 more/);
    await userEvent.click(screen.getByRole('button', { name: '250 vehicles silent' }));
    expect(onselect.mock.calls[0]![0]).toHaveLength(250);
    await userEvent.click(screen.getByRole('button', { name: /^Acknowledge/ }));
    expect(station.asked).toEqual([{ type: 'acknowledge_alarms', numbers: Array.from({ length: 250 }, (_, index) => index + 1) }]);
  });

  it('keeps what is acknowledged quietly, and tells nothing old as new', () => {
    const station = TestStation.live();
    render(AlarmBanner, { props: { onselect: vi.fn() }, context: station.context });
    station.tell({ type: 'alarms', alarms: [{ ...silent(1), acknowledged_by: 'operator 2' }] });
    expect(screen.queryByRole('alert')).toBeNull();
    expect(screen.getByText('acknowledged by operator 2')).toBeInTheDocument();
    station.goAway();
    expect(screen.queryByText('acknowledged by operator 2')).toBeNull();
    station.end();
  });
});

describe('the emergency banner', () => {
  const emergency: Emergency = {
    latched: true,
    action: 'hold',
    by: 'operator 2',
    vehicles: [
      { vehicle: '1', acknowledged: true, confirmed: true, tries: 1, detail: '' },
      { vehicle: '2', acknowledged: false, confirmed: false, tries: 4, detail: 'link lost' },
    ],
  };

  it('tells what each vehicle made of it, and lets go only after a hold', async () => {
    vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
    const station = TestStation.live([copter('1'), copter('2')]);
    render(EmergencyBanner, { context: station.context });
    expect(screen.queryByRole('region')).toBeNull();
    station.tell({ type: 'emergency', ...emergency });
    expect(screen.getByRole('region', { name: 'Emergency stop' })).toHaveTextContent(/hold, by operator 2.*1 of 2 stopped, 1 acknowledged/);
    expect(screen.getByRole('row', { name: /copter 2/ })).toHaveTextContent(/… try 4.*link lost/);
    const release = screen.getByRole('button', { name: 'Release' });
    await fireEvent.keyDown(release, { key: 'Enter' });
    expect(station.asked).toEqual([]);
    await vi.advanceTimersByTimeAsync(1000);
    expect(station.asked).toEqual([{ type: 'release_emergency_stop' }]);
  });

  it('leads who has asked for the stop to Release, and back to where he was', async () => {
    const station = TestStation.live();
    const before = document.body.appendChild(document.createElement('button'));
    const { component } = render(EmergencyBanner, { context: station.context });
    before.focus();
    (component as unknown as { expectFocus(): void }).expectFocus();
    station.tell({ type: 'emergency', ...emergency });
    expect(screen.getByRole('button', { name: 'Release' })).toHaveFocus();
    station.tell({ type: 'emergency', ...emergency, latched: false });
    await Promise.resolve();
    expect(before).toHaveFocus();
    before.remove();
  });

  it('leaves the focus of who has not asked for it', () => {
    const station = TestStation.live();
    render(EmergencyBanner, { context: station.context });
    station.tell({ type: 'emergency', ...emergency });
    expect(document.body).toHaveFocus();
  });

  it('shows Motors off behind a second step, without Release beside it', async () => {
    const station = TestStation.live();
    render(EmergencyBanner, { context: station.context });
    station.tell({ type: 'emergency', ...emergency });
    await userEvent.click(screen.getByRole('button', { name: 'Motors off…' }));
    expect(screen.getByRole('group', { name: 'Motors off' })).toBeVisible();
    expect(screen.queryByRole('button', { name: 'Release' })).toBeNull();
  });
});

it('says that the station is lost, and how old the data are', async () => {
  const station = TestStation.live([copter('1')]);
  render(LostBanner, { context: station.context });
  station.goAway();
  expect(screen.getByText(/Station lost/).parentElement).toHaveTextContent(
    /data 0\.\d s old, vehicles carry on; E-STOP does not reach them/,
  );
  expect(station.stores.session.alert).toContain('Station lost');
  await userEvent.click(screen.getByRole('button', { name: 'Try now' }));
  station.tell({ type: 'hello', protocol: 1, version: '0.1.0', server_time: '', site: { name: '' } });
  expect(screen.queryByText(/Station lost/)).toBeNull();
  expect(station.stores.session.alert).toBe('The station is back.');
  station.end();
});

it('asks whether a vehicle is handed over', async () => {
  const control = { commander: 'operator 1', asked_for_by: 'operator 2', granted_at_s: 110 };
  const station = TestStation.live([copter('1', { control })]);
  render(RequestBanner, { context: station.context });
  expect(screen.getByRole('group', { name: 'operator 2 asks for copter 1' })).toHaveTextContent(/granted in (9|10) s/);
  await userEvent.click(screen.getByRole('button', { name: 'Keep' }));
  expect(station.asked).toEqual([{ type: 'keep_control', vehicle: '1' }]);
});

it('says that a stop failed until somebody has read it', async () => {
  const station = TestStation.live();
  render(StopNotice, { context: station.context });
  const stopped = station.stores.control.emergencyStop();
  await station.reply({ ok: false, error: { message: 'Nobody is there.', hint: '' } });
  expect(await stopped).toBe(false);
  expect(await screen.findByRole('group', { name: 'E-STOP failed' })).toHaveTextContent(/Nobody is there.*remote control/);
  await userEvent.click(screen.getByRole('button', { name: 'Close' }));
  expect(screen.queryByRole('group')).toBeNull();
});
