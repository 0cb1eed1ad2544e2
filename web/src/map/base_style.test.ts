import { expect, it } from 'vitest';
import { BASE, baseStyle } from './base_style';

const archive = { id: 'a', name: 'A', attribution: '', url: '/api/v1/basemaps/a/tiles/{z}/{x}/{y}', min_zoom: 0, max_zoom: 0 } as const;

it('asks an archive for no deeper tile than it has, though that be the world as one', () => {
  for (const kind of ['tiles', 'vector_tiles'] as const) {
    const { sources } = baseStyle({ ...archive, kind, vector_layers: ['water'] }, undefined, false);
    expect(sources[BASE]).toMatchObject({ type: kind === 'tiles' ? 'raster' : 'vector', minzoom: 0, maxzoom: 0 });
  }
});
