import { render, screen } from '@testing-library/svelte';
import { expect, it } from 'vitest';
import { copter, TestStation } from '../testing/station';
import CommandTable from './CommandTable.svelte';

it('shows the three latest commands, the newest first and open', () => {
  const station = TestStation.live([copter('1')]);
  render(CommandTable, { context: station.context });
  const commands = [1, 2, 3, 4].map((number) => ({
    number,
    action: 'set_mode' as const,
    mode: `MODE${number}`,
    by: 'operator 1',
    asked: '2026-05-01T12:00:00Z',
    vehicles: [{ vehicle: '1', state: 'confirmed' as const }],
  }));
  station.tell({ type: 'commands', commands });
  const shown = screen.getAllByRole('group');
  expect(shown.map((one) => one.querySelector('.title')!.textContent)).toEqual(['Set mode MODE4', 'Set mode MODE3', 'Set mode MODE2']);
  expect(shown.map((one) => (one as HTMLDetailsElement).open)).toEqual([true, false, false]);
  expect(shown[0]).toHaveTextContent(/1 of 1 confirmed.*copter 1.*✔ confirmed/);
});
