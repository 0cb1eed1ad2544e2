import { render, screen, within } from '@testing-library/svelte';
import { expect, it } from 'vitest';
import type { Task } from '../lib/protocol';
import TaskPanel from './TaskPanel.svelte';

it('shows the tasks as a tree, each with its state', () => {
  const child = (id: number, label: string, state: Task['state']): Task => ({ id, kind: 'mission', label, line: id, state, vehicle: '1' });
  const children = [child(2, 'north', 'running'), child(3, 'south', 'failed')];
  const trees: Task[] = [{ id: 1, kind: 'concurrent', label: '', line: 9, state: 'running', children }];
  render(TaskPanel, { props: { trees } });
  const [root] = screen.getAllByRole('listitem');
  expect(within(root!).getByText('north').closest('li')).toHaveClass('running');
  expect(within(within(root!).getByText('south').closest('li')!).getByRole('img', { name: 'failed' })).toBeVisible();
});

it('says what will be there', () => {
  render(TaskPanel, { props: { trees: [] } });
  expect(screen.getByText(/No task yet/)).toBeVisible();
});

it('tells in words what has no name', () => {
  render(TaskPanel, { props: { trees: [{ id: 1, kind: 'choice', label: '<choice>', line: 3, state: 'running' }] } });
  expect(screen.getByRole('listitem')).toHaveTextContent('whichever comes first');
  expect(screen.getByRole('listitem')).not.toHaveTextContent('<');
});
