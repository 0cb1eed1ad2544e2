import { fireEvent, render, screen, within } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it } from 'vitest';
import type { MapLayer } from '../../layers/layer';
import { TestStation } from '../../testing/station';
import LayersPanel from './LayersPanel.svelte';

const layer = (id: string, group: MapLayer['group'], name = id): MapLayer => ({
  id,
  name,
  group,
  legend: [{ sign: 'line', text: `what ${id} means` }],
  sources: {},
  layers: () => [],
  update: () => {},
});
const layers = [layer('grid', 'Ground'), layer('plans', 'Paths'), layer('trails', 'Paths'), layer('measure', 'Tools')];

it('lists what lies on the map by groups, with its legend, the topmost first, and no tools', () => {
  render(LayersPanel, { props: { layers }, context: TestStation.live().context });
  const paths = screen.getByRole('group', { name: 'Paths' });
  expect(
    within(paths)
      .getAllByRole('checkbox')
      .map((box) => box.closest('label')!.textContent.trim()),
  ).toEqual(['trails', 'plans']);
  expect(screen.getByText('what grid means')).toBeVisible();
  expect(screen.queryByText('measure')).toBeNull();
});

it('hides, fades and moves a layer, and has all as at first again', async () => {
  const station = TestStation.live();
  const { mapLayers } = station.stores;
  render(LayersPanel, { props: { layers }, context: station.context });
  await userEvent.click(screen.getByRole('checkbox', { name: 'grid' }));
  expect(mapLayers.lookOf('grid').visible).toBe(false);
  expect(screen.getByLabelText('Opacity of grid')).toBeDisabled();
  await fireEvent.input(screen.getByLabelText('Opacity of trails'), { target: { value: '0.5' } });
  expect(mapLayers.lookOf('trails').opacity).toBe(0.5);
  await userEvent.click(screen.getByRole('button', { name: 'plans further up' }));
  expect(mapLayers.ordered(layers).map(({ id }) => id)).toEqual(['grid', 'trails', 'plans', 'measure']);
  expect(screen.getByRole('button', { name: 'plans further up' })).toBeDisabled();
  await userEvent.click(screen.getByRole('button', { name: 'As at first' }));
  expect(screen.getByRole('checkbox', { name: 'grid' })).toBeChecked();
});
