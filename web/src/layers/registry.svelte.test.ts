import { validateStyleMin } from '@maplibre/maplibre-gl-style-spec';
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { DARK } from '../map/colours';
import { TestStation } from '../testing/station';
import type { Drawing, MapLayer } from './layer';

let layers: MapLayer[];
let style: (typeof import('../map/style'))['mapStyle'];
beforeAll(async () => {
  URL.createObjectURL = () => ''; // MapLibre asks for it as soon as it is loaded
  const [registry, { mapStyle }] = await Promise.all([import('./registry'), import('../map/style')]);
  layers = registry.makeLayers(TestStation.live().stores);
  style = mapStyle;
});

describe('the layers of the map', () => {
  it('make a valid style together, with tiles and without', () => {
    for (const tiles of ['', 'https://tiles.example/{z}/{x}/{y}.png']) {
      expect(validateStyleMin({ ...style(layers, DARK, tiles), glyphs: 'https://glyphs.example/{fontstack}/{range}.pbf' })).toEqual([]);
    }
  });

  it('have names and sources of their own', () => {
    const twice = (names: string[]): string[] => names.filter((name, index) => names.indexOf(name) !== index);
    expect(twice(layers.map(({ id }) => id))).toEqual([]);
    expect(twice(layers.flatMap(({ sources }) => Object.keys(sources)))).toEqual([]);
    for (const layer of layers) {
      const used = layer.layers(DARK, false).flatMap((look) => ('source' in look ? [look.source] : []));
      expect([...new Set(used)].sort(), layer.id).toEqual(Object.keys(layer.sources).sort());
    }
  });

  it('send a source nothing while nothing of it has changed', async () => {
    const station = TestStation.live([{ id: '1', position: { lat_deg: 1, lon_deg: 2, alt_m: 3 } }]);
    const { trails } = await import('./trails');
    const layer = trails(station.stores);
    const [setData, updateData] = [vi.fn(), vi.fn()];
    const drawing = { generation: 1, colourOf: () => 'red', source: () => ({ setData, updateData }) } as unknown as Drawing;
    layer.update(drawing);
    layer.update(drawing);
    expect(setData).toHaveBeenCalledTimes(1);
    station.tell({ type: 'vehicles', time_s: 2, full: false, vehicles: [{ id: '1', position: { lat_deg: 1.1, lon_deg: 2, alt_m: 3 } }] });
    layer.update(drawing);
    expect(setData).toHaveBeenCalledTimes(2);
    expect(updateData).toHaveBeenCalledTimes(1);
  });
});
