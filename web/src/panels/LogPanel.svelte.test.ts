import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it } from 'vitest';
import type { LogLine } from '../lib/protocol';
import { TestStation } from '../testing/station';
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
