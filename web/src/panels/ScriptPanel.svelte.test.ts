import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it } from 'vitest';
import type { Diagnostic, Script } from '../lib/protocol';
import { TestStation } from '../testing/station';
import ScriptPanel from './ScriptPanel.svelte';

const script: Script = { name: 'a/survey.dolphin', state: 'done', message: '', source: 'one\ntwo\nthree', diagnostics: [] };

function show(state: Partial<Script> = {}): TestStation {
  const station = TestStation.live();
  station.tell({ type: 'script', ...script, ...state });
  render(ScriptPanel, { context: station.context });
  return station;
}

it('marks the lines that run', () => {
  const station = show({ state: 'running' });
  station.tell({ type: 'tasks', trees: [{ id: 1, kind: 'action', label: '', line: 2, state: 'running' }] });
  const current = screen.getAllByRole('listitem').filter((line) => line.getAttribute('aria-current') === 'step');
  expect(current.map((line) => line.textContent?.trim())).toEqual(['two']);
});

it('starts what is edited, and shows every mistake at its place', async () => {
  const user = userEvent.setup();
  const station = show();
  await user.click(screen.getByRole('button', { name: 'Edit' }));
  const editor = screen.getByLabelText<HTMLTextAreaElement>('Script text');
  await user.clear(editor);
  await user.type(editor, 'takeOf here');
  await user.click(screen.getByRole('button', { name: 'Start' }));
  expect(station.asked).toEqual([{ type: 'start_script', name: 'a/survey.dolphin', source: 'takeOf here' }]);
  const mistake: Diagnostic = {
    severity: 'error',
    file: 'a',
    line: 1,
    column: 1,
    end_line: 1,
    end_column: 7,
    message: 'takeOf is not defined',
    hint: 'did you mean takeOff?',
  };
  await station.reply({ ok: false, error: { message: 'The script does not check.', hint: 'Mend it.' }, diagnostics: [mistake] });
  await user.click(await screen.findByRole('button', { name: /takeOf is not defined – did you mean takeOff/ }));
  expect(editor.value.slice(editor.selectionStart, editor.selectionEnd)).toBe('takeOf');
  await user.click(screen.getByRole('button', { name: 'Discard' }));
  expect(screen.queryByText('The script does not check.')).toBeNull();
});

it('starts nothing while a script runs, or without a station', () => {
  const station = show({ state: 'running' });
  expect(screen.getByRole('button', { name: 'Start' })).toBeDisabled();
  station.tell({ type: 'script', ...script });
  expect(screen.getByRole('button', { name: 'Start' })).toBeEnabled();
  station.goAway();
  expect(screen.getByRole('button', { name: 'Start' })).toBeDisabled();
  station.end();
});
