import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { createRawSnippet } from 'svelte';
import { expect, it } from 'vitest';
import Panel from './Panel.svelte';

const children = createRawSnippet(() => ({ render: () => '<p>what is in it</p>' }));

it('folds and unfolds, a tool being folded at first', async () => {
  render(Panel, { props: { id: 'parameters', title: 'Parameters', tool: true, children } });
  expect(screen.queryByText('what is in it')).toBeNull();
  await userEvent.click(screen.getByRole('button', { name: 'Parameters', expanded: false }));
  expect(screen.getByText('what is in it')).toBeVisible();
});

it('cannot be folded where tabs choose the panel', () => {
  render(Panel, { props: { id: 'log', title: 'Log', fixed: true, tool: true, children } });
  expect(screen.queryByRole('button')).toBeNull();
  expect(screen.getByText('what is in it')).toBeVisible();
});
