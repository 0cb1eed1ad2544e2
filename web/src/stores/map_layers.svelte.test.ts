import { expect, it } from 'vitest';
import { MapLayersStore } from './map_layers.svelte';

const layers = ['grid', 'trails', 'vehicles'].map((id) => ({ id }));
const ids = (store: MapLayersStore, of = layers) => store.ordered(of).map(({ id }) => id);

it('keeps what was hidden, faded and moved', () => {
  const store = new MapLayersStore();
  expect(store.lookOf('grid')).toEqual({ visible: true, opacity: 1 });
  store.setVisible('grid', false);
  store.setOpacity('trails', 0.4);
  store.move(layers, 'grid', true);
  const later = new MapLayersStore();
  expect(later.lookOf('grid')).toEqual({ visible: false, opacity: 1 });
  expect(later.lookOf('trails').opacity).toBe(0.4);
  expect(ids(later)).toEqual(['trails', 'grid', 'vehicles']);
  later.reset();
  expect(ids(new MapLayersStore())).toEqual(['grid', 'trails', 'vehicles']);
});

it('leaves a layer that is new at its place, and does not miss one that is gone', () => {
  const store = new MapLayersStore();
  store.move(layers, 'vehicles', false);
  expect(ids(store)).toEqual(['grid', 'vehicles', 'trails']);
  expect(ids(store, [{ id: 'ground' }, ...layers])).toEqual(['ground', 'grid', 'vehicles', 'trails']);
  expect(ids(store, layers.slice(1))).toEqual(['vehicles', 'trails']);
  store.move(layers, 'trails', true);
  store.move(layers, 'nobody', true);
  expect(ids(store)).toEqual(['grid', 'vehicles', 'trails']);
});

it('begins as at first where something else was kept', () => {
  for (const spoilt of ['{', '{"looks":{"grid":{"visible":"no","opacity":7}},"order":4}', 'null', '[]']) {
    localStorage.setItem('lapwing.layers', spoilt);
    const store = new MapLayersStore();
    expect(store.lookOf('grid')).toEqual({ visible: true, opacity: 1 });
    expect(ids(store)).toEqual(['grid', 'trails', 'vehicles']);
  }
});
