import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { createRawSnippet } from 'svelte';
import { expect, it, vi } from 'vitest';
import Dock from './Dock.svelte';

const panel = (words: string) => createRawSnippet(() => ({ render: () => `<p>${words}</p>` }));
const tabs = [
  { id: 'script', title: 'Script', count: 'a.dolphin', panel: panel('what runs') },
  { id: 'log', title: 'Log', panel: panel('what was told') },
];
const usual = { tabs, height: 240, isSheet: false, covers: 0 };

it('shows one panel, and keeps what was looked at', async () => {
  const [onchoose, onresize] = [vi.fn(), vi.fn()];
  const { rerender } = render(Dock, { props: { ...usual, current: 'script', onchoose, onresize } });
  expect(screen.getByRole('tab', { name: /Script.*a\.dolphin/, selected: true })).toBeVisible();
  expect(screen.getByRole('tabpanel', { name: /Script/ })).toHaveTextContent('what runs');
  expect(screen.queryByText('what was told')).toBeNull();
  await userEvent.click(screen.getByRole('tab', { name: 'Log' }));
  expect(onchoose).toHaveBeenCalledWith('log');
  await rerender({ current: 'log' });
  expect(screen.getByText('what was told')).toBeVisible();
  expect(screen.getByText('what runs')).not.toBeVisible();
});

it('is closed by its own tab and its button', async () => {
  const onchoose = vi.fn();
  const { rerender } = render(Dock, { props: { ...usual, current: 'log', onchoose, onresize: vi.fn() } });
  await userEvent.click(screen.getByRole('tab', { name: 'Log' }));
  await userEvent.click(screen.getByRole('button', { name: 'Close the panel' }));
  expect(onchoose.mock.calls).toEqual([[''], ['']]);
  await rerender({ current: '' });
  expect(screen.queryByRole('tabpanel')).toBeNull();
});

it('is gone along and sized by keyboard', async () => {
  const onresize = vi.fn();
  render(Dock, { props: { ...usual, current: 'script', onchoose: vi.fn(), onresize } });
  screen.getByRole('tab', { name: /Script/ }).focus();
  await userEvent.keyboard('{ArrowRight}');
  expect(screen.getByRole('tab', { name: 'Log' })).toHaveFocus();
  await userEvent.keyboard('{ArrowRight}');
  expect(screen.getByRole('tab', { name: /Script/ })).toHaveFocus();
  await userEvent.keyboard('{ArrowLeft}');
  expect(screen.getByRole('tab', { name: 'Log' })).toHaveFocus();
  screen.getByRole('separator').focus();
  await userEvent.keyboard('{ArrowUp}{ArrowDown}');
  expect(onresize.mock.calls).toEqual([[264], [216]]);
});
