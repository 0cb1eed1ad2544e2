import type { FeatureCollection } from 'geojson';
import { addressStyle, baseStyle, PLAIN } from '../map/base_style';
import { validateStyleMin } from '@maplibre/maplibre-gl-style-spec';
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { DARK } from '../map/colours';
import { TestStation } from '../testing/station';
import { GROUPS, type Drawing, type MapLayer } from './layer';

let layers: MapLayer[];
let makeLayers: (typeof import('./registry'))['makeLayers'];
let style: (typeof import('../map/style'))['mapStyle'];
beforeAll(async () => {
  URL.createObjectURL = () => ''; // MapLibre asks for it as soon as it is loaded
  const [registry, { mapStyle }] = await Promise.all([import('./registry'), import('../map/style')]);
  makeLayers = registry.makeLayers;
  layers = makeLayers(TestStation.live().stores);
  style = mapStyle;
});

const ground: FeatureCollection = { type: 'FeatureCollection', features: [] };
const drawing = baseStyle({ id: 'yard', name: 'Yard', attribution: '', kind: 'drawing', url: '/yard' }, ground, true);

describe('the layers of the map', () => {
  it('make a valid style together, with tiles and without', () => {
    for (const base of [PLAIN, addressStyle('https://tiles.example/{z}/{x}/{y}.png'), drawing]) {
      expect(validateStyleMin({ ...style(layers, DARK, base), glyphs: 'https://glyphs.example/{fontstack}/{range}.pbf' })).toEqual([]);
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

  it('draw what covers the whole map, and what there are thousands of, in the way that takes least', () => {
    const all = style(layers, DARK, PLAIN).layers;
    expect(all.filter(({ type }) => type === 'background')).toEqual([]);
    const slots = all.filter((look) => 'source' in look && look.source === 'found-slots').map(({ type }) => type);
    expect(slots).toEqual(['fill', 'symbol']);
  });

  it('are named and grouped for the list of layers', () => {
    for (const { id, name, group } of layers) expect([...GROUPS, 'Tools'], `${id}: ${name}`).toContain(group);
    expect(layers.map(({ name }) => name)).not.toContain('');
  });

  it('are as clear as they are wanted, whatever clearness they have by themselves', () => {
    const all = style(layers, DARK, PLAIN, (id) => ({ visible: id !== 'grid', opacity: id === 'plans' ? 0.5 : 1 })).layers;
    const of = (id: string) => all.find((layer) => layer.id === id)!;
    expect(of('grid').layout?.visibility).toBe('none');
    expect(of('plans').paint).toMatchObject({ 'line-opacity': 0.45 });
    expect(of('plan-points').paint).toMatchObject({ 'circle-opacity': 0.425, 'circle-stroke-opacity': 0.5 });
    const plain = style(layers, DARK, PLAIN).layers.find((layer) => layer.id === 'plans')!;
    expect(plain.paint).toMatchObject({ 'line-opacity': 0.9 });
  });

  it('neither send a source anything nor want to be painted while nothing of them has changed', () => {
    const position = { lat_deg: 1, lon_deg: 2, alt_m: 3 };
    const station = TestStation.live([{ id: '1', name: 'copter 1', position, home: position, heading_rad: 1 }]);
    const told = { setData: vi.fn(), updateData: vi.fn() };
    const wantsPaint = vi.fn();
    const drawing = {
      ...{ generation: 1, zoom: 15, selected: ['1'], measured: [], colourOf: () => 'red', source: () => told, wantsPaint },
      view: { west: 0, east: 1, south: 0, north: 1 },
    } as unknown as Drawing;
    const sentBy = (layer: MapLayer): number => {
      for (const { mock } of [told.setData, told.updateData, wantsPaint]) mock.calls.length = 0;
      layer.update(drawing);
      return [told.setData, told.updateData, wantsPaint].reduce((sum, { mock }) => sum + mock.calls.length, 0);
    };
    const mine = makeLayers(station.stores).filter(({ id }) =>
      ['trails', 'vehicles', 'intents', 'homes', 'destinations', 'measure'].includes(id),
    );
    for (const layer of mine) sentBy(layer);
    station.tell({ type: 'vehicles', time_s: 2, full: false, vehicles: [{ id: '1', age_s: { position: 0 }, position: { ...position } }] });
    for (const layer of mine) expect(sentBy(layer), layer.id).toBe(0);
    station.tell({ type: 'vehicles', time_s: 3, full: false, vehicles: [{ id: '1', position: { ...position, lat_deg: 1.1 } }] });
    for (const layer of mine) expect(sentBy(layer) > 0, layer.id).toBe(['trails', 'vehicles', 'intents'].includes(layer.id));
  });
});
