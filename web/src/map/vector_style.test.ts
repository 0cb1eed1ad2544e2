import { validateStyleMin } from '@maplibre/maplibre-gl-style-spec';
import { expect, it } from 'vitest';
import { kindOf, vectorLooks } from './vector_style';

it('knows what layers are by their names, in each schema that is in use', () => {
  expect(['water', 'waterway', 'water_polygons', 'ocean'].map(kindOf)).toEqual(['water', 'water', 'water', 'water']);
  expect(['transportation', 'roads', 'streets', 'aeroway', 'ferries'].every((name) => kindOf(name) === 'road')).toBe(true);
  expect(['landuse', 'landcover', 'earth', 'park', 'sites'].every((name) => kindOf(name) === 'land')).toBe(true);
  expect(['boundary', 'boundaries', 'admin'].every((name) => kindOf(name) === 'boundary')).toBe(true);
  expect(['building', 'buildings'].every((name) => kindOf(name) === 'building')).toBe(true);
  expect(['place', 'pois', 'transportation_name', 'water_name', 'street_labels'].every((name) => kindOf(name) === 'place')).toBe(true);
});

it('lays ground below water below roads below names, as a style that a map takes', () => {
  for (const isDark of [true, false]) {
    const layers = vectorLooks('base', ['place', 'roads', 'water', 'landuse', 'boundary', 'building'], isDark);
    const style = {
      version: 8 as const,
      sources: { base: { type: 'vector' as const, tiles: ['x://{z}/{x}/{y}'] } },
      layers,
      glyphs: 'x://{fontstack}/{range}',
    };
    expect(validateStyleMin(style)).toEqual([]);
    const ids = layers.map(({ id }) => id);
    const order = ['base-fill-landuse', 'base-fill-water', 'base-line-roads', 'base-line-boundary', 'base-name-place'].map((id) =>
      ids.indexOf(id),
    );
    expect(order).toEqual([...order].sort((a, b) => a - b));
    expect(order.every((at) => at >= 0)).toBe(true);
    expect(ids).not.toContain('base-fill-boundary');
  }
});
