import type { FeatureCollection } from 'geojson';
import type { LayerSpecification, SourceSpecification } from 'maplibre-gl';
import type { BaseMap } from '../stores/base_maps.svelte';
import { stationTiles } from './station_tiles';
import { vectorLooks } from './vector_style';

/** What lies under everything, as parts of a style. */
export interface BaseStyle {
  sources: Record<string, SourceSpecification>;
  layers: LayerSpecification[];
}

export const BASE = 'base';
export const PLAIN: BaseStyle = { sources: {}, layers: [] };

/** Tiles of an address that somebody has set in this browser. */
export function addressStyle(url: string): BaseStyle {
  return tiles({ type: 'raster', tiles: [url], tileSize: 256, maxzoom: 19 });
}

export function baseStyle(base: BaseMap | undefined, drawing: FeatureCollection | undefined, isDark: boolean): BaseStyle {
  if (!base) return PLAIN;
  if (base.kind === 'drawing') return drawing ? drawn(drawing, isDark ? NIGHT : DAY) : PLAIN;
  const { min_zoom: minzoom, max_zoom: maxzoom, bounds_deg: bounds } = base;
  const address = base.url.startsWith('/') ? stationTiles.address(BASE) : base.url;
  const where = {
    tiles: [address],
    ...(minzoom !== undefined && { minzoom }),
    ...(maxzoom !== undefined && { maxzoom }),
    ...(bounds && { bounds }),
  };
  if (base.kind === 'tiles') return tiles({ type: 'raster', tileSize: 256, ...where });
  return { sources: { [BASE]: { type: 'vector', ...where } }, layers: vectorLooks(BASE, base.vector_layers ?? [], isDark) };
}

function tiles(source: SourceSpecification): BaseStyle {
  return { sources: { [BASE]: source }, layers: [{ id: BASE, type: 'raster', source: BASE }] };
}

type Palette = Record<
  'lawn' | 'road' | 'asphalt' | 'building' | 'room' | 'slot' | 'lane' | 'door' | 'path' | 'tree' | 'edge' | 'name',
  string
>;

const DAY: Palette = { lawn: '#dbe7d2', road: '#c9ced3', asphalt: '#d6d9dc', building: '#e9e1d6', room: '#f7f2ea', slot: '#ffffff', lane: '#ffffff', door: '#b98a4e', path: '#cfc6b4', tree: '#a9c79a', edge: '#a89f90', name: '#5c6670' }; // prettier-ignore
const NIGHT: Palette = { lawn: '#142019', road: '#252d33', asphalt: '#1d242a', building: '#2b2822', room: '#37332b', slot: '#5b666f', lane: '#69747d', door: '#a97d43', path: '#39352c', tree: '#274230', edge: '#6b6354', name: '#9fabb4' }; // prettier-ignore

/** Ground that was drawn as polygons and lines, each of a kind; the lowest first. */
function drawn(data: FeatureCollection, colours: Palette): BaseStyle {
  const of = (...kinds: string[]): unknown => ['in', ['get', 'kind'], ['literal', kinds]];
  const fill = (kind: keyof Palette): unknown => ({
    id: `base-${kind}`,
    type: 'fill',
    filter: of(kind),
    paint: { 'fill-color': colours[kind] },
  });
  const line = (kind: keyof Palette, width: number, more = {}): unknown => ({
    id: `base-${kind}-line`,
    type: 'line',
    filter: of(kind),
    paint: { 'line-color': colours[kind], 'line-width': width, ...more },
  });
  const layers = [
    ...(['lawn', 'road', 'asphalt', 'building', 'room', 'tree'] as const).map(fill),
    line('path', 4),
    line('lane', 1.4, { 'line-dasharray': [6, 6] }),
    line('slot', 1),
    { id: 'base-walls', type: 'line', filter: of('building', 'room'), paint: { 'line-color': colours.edge, 'line-width': 1.4 } },
    line('door', 3),
    {
      id: 'base-names',
      type: 'symbol',
      minzoom: 17.5,
      filter: ['all', ['has', 'name'], of('room', 'building', 'road', 'asphalt')],
      layout: { 'text-field': ['get', 'name'], 'text-font': ['system-ui', 'sans-serif'], 'text-size': 11 },
      paint: { 'text-color': colours.name, 'text-halo-color': colours.room, 'text-halo-width': 0.8 },
    },
  ];
  return {
    sources: { [BASE]: { type: 'geojson', data } },
    layers: (layers as LayerSpecification[]).map((one) => ({ ...one, source: BASE }) as LayerSpecification),
  };
}
