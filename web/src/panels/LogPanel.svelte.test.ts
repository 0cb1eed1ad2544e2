import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it } from 'vitest';
import type { LogLine } from '../lib/protocol';
import { copter, TestStation } from '../testing/station';
import LogPanel from './LogPanel.svelte';

const lines: LogLine[] = (['debug', 'info', 'warn', 'error'] as const).map((level, index) => ({
  seq: index + 1,
  time: `2026-05-01T12:00:0${index}Z`,
  level,
  source: 'vehicle 1',
  text: `a ${level} line`,
}));

it('shows what the station tells, from the level that is chosen on', async () => {
  const station = TestStation.live();
  render(LogPanel, { context: station.context });
  expect(screen.getByText('Nothing to show.')).toBeVisible();
  station.tell({ type: 'log', lines });
  const log = screen.getByRole('log');
  expect(log).not.toHaveTextContent('a debug line');
  expect(log).toHaveTextContent(/a info line.*a warn line.*a error line/s);
  await userEvent.selectOptions(screen.getByLabelText('Show'), 'Errors only');
  expect(log).not.toHaveTextContent('a warn line');
  await userEvent.selectOptions(screen.getByLabelText('Show'), 'Everything');
  expect(log).toHaveTextContent('a debug line');
});

it('has each line once, and goes on after a station that counts anew', () => {
  const station = TestStation.live();
  render(LogPanel, { context: station.context });
  station.tell({ type: 'log', lines }, { type: 'log', lines });
  expect(screen.getAllByText(/a error line/)).toHaveLength(1);
  station.tell({ type: 'log', lines: [{ ...lines[1]!, time: '2026-05-01T13:00:00Z', text: 'started anew' }] });
  expect(screen.getByText(/started anew/)).toBeVisible();
});

it('has a command as one line, with each vehicle below, and finds what is about one vehicle', async () => {
  const user = userEvent.setup({ delay: null });
  const station = TestStation.live([copter('1'), copter('2')]);
  render(LogPanel, { props: { selected: ['2'] }, context: station.context });
  const say = (text: string, seq: number): LogLine => ({ seq, time: '2026-05-01T12:00:00Z', level: 'info', source: 'control', text });
  station.tell({
    type: 'log',
    lines: [
      say('operator 1 commands land to 2 vehicles', 1),
      say('land of vehicle 1: confirmed', 2),
      say('land of vehicle 2: confirmed', 3),
      say('copter 1: restarted', 4),
    ],
  });
  const log = screen.getByRole('log');
  expect(log.querySelectorAll(':scope > *')).toHaveLength(2);
  expect(log).toHaveTextContent('operator 1 commands land to 2 vehicles: 2 confirmed');
  await user.selectOptions(screen.getByLabelText('About'), 'The selected');
  expect(log).not.toHaveTextContent('restarted');
  expect(log).toHaveTextContent('land of vehicle 2: confirmed');
  await user.selectOptions(screen.getByLabelText('About'), 'copter 1');
  await user.type(screen.getByLabelText('Search the log'), 'restart');
  expect(log.querySelectorAll(':scope > *')).toHaveLength(1);
  await user.type(screen.getByLabelText('Search the log'), ' nobody');
  expect(screen.getByText('Nothing is like that.')).toBeVisible();
});

it('goes on following when the panel changes its size, and stops when somebody scrolls', () => {
  const station = TestStation.live();
  render(LogPanel, { context: station.context });
  const log = screen.getByRole('log');
  const size = { scrollHeight: 1000, clientHeight: 0 };
  Object.defineProperties(log, { scrollHeight: { get: () => size.scrollHeight }, clientHeight: { get: () => size.clientHeight } });
  const scroll = (to: number): void => void ((log.scrollTop = to), log.dispatchEvent(new Event('scroll')), station.tell());
  size.clientHeight = 100; // what the panel was told last is another height
  scroll(300);
  expect(screen.queryByRole('button', { name: /Newest/ })).toBeNull();
  size.clientHeight = 0;
  scroll(300);
  expect(screen.getByRole('button', { name: /Newest/ })).toBeVisible();
  scroll(1000);
  expect(screen.queryByRole('button', { name: /Newest/ })).toBeNull();
});
