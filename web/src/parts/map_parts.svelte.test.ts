import { render, screen } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { expect, it, vi } from 'vitest';
import { TestStation } from '../testing/station';
import MapButtons from './MapButtons.svelte';
import MeasureBar from './MeasureBar.svelte';
import Readout from './Readout.svelte';

it('tells the place of the pointer in the form that was chosen, and keeps it', async () => {
  render(Readout, { props: { place: { lat_deg: 48.858222, lon_deg: 2.2945 } }, context: TestStation.live().context });
  const place = screen.getByRole('button');
  expect(place).toHaveTextContent('WGS84 48.85822° N, 2.29450° E');
  await userEvent.click(place);
  expect(place).toHaveTextContent('UTM 31U 448251 E 5411935 N');
  await userEvent.click(place);
  expect(place).toHaveTextContent('MGRS 31U DQ 48251 11935');
  expect(localStorage.getItem('lapwing.coordinates')).toBe('MGRS');
});

it('has one tool at a time, and follows only one vehicle that is selected', async () => {
  const props = { tool: 'none' as const, following: false, canFollow: false, onfit: vi.fn(), onzoom: vi.fn() };
  const { rerender } = render(MapButtons, { props });
  expect(screen.getByRole('button', { name: 'Follow the vehicle' })).toBeDisabled();
  await userEvent.click(screen.getByRole('button', { name: 'Measure' }));
  await userEvent.click(screen.getByRole('button', { name: 'Select with a lasso' }));
  expect(screen.getByRole('button', { name: 'Measure', pressed: false })).toBeVisible();
  expect(screen.getByRole('button', { name: 'Select with a lasso', pressed: true })).toBeVisible();
  await rerender({ canFollow: true });
  await userEvent.click(screen.getByRole('button', { name: 'Follow the vehicle' }));
  expect(screen.getByRole('button', { name: 'Follow the vehicle', pressed: true })).toBeVisible();
});

it('tells how far it is along the places, and takes the last one back', async () => {
  const onundo = vi.fn();
  const at = (north: number) => ({ lat_deg: north / 111_319.49, lon_deg: 0, alt_m: 0 });
  const { rerender } = render(MeasureBar, { props: { places: [at(0)], onundo, onend: vi.fn() } });
  expect(screen.getByRole('status')).toHaveTextContent(/Click from place to place/);
  await rerender({ places: [at(0), at(300), at(200)] });
  expect(screen.getByRole('status')).toHaveTextContent('400 m');
  await rerender({ places: [at(0), at(12_000)] });
  expect(screen.getByRole('status')).toHaveTextContent('12.0 km');
  await userEvent.click(screen.getByRole('button', { name: 'Back' }));
  expect(onundo).toHaveBeenCalledTimes(1);
});
