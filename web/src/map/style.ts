import type { FeatureCollection } from 'geojson';
import type { LayerSpecification, StyleSpecification } from 'maplibre-gl';

export interface MapColours {
  ground: string;
  minor: string;
  major: string;
  label: string;
}

export const DARK: MapColours = { ground: '#0c1318', minor: '#18252e', major: '#273a47', label: '#7f97a6' };
export const LIGHT: MapColours = { ground: '#eef2f3', minor: '#e0e7ea', major: '#c9d5da', label: '#637987' };

const EMPTY: FeatureCollection = { type: 'FeatureCollection', features: [] };

/** The whole map but for markers: ground, optional tiles, grid, plans, trails. Text is drawn with the browser's own fonts. */
export function mapStyle(colours: MapColours, tiles: string): StyleSpecification {
  return {
    version: 8,
    sources: {
      grid: { type: 'geojson', data: EMPTY },
      plans: { type: 'geojson', data: EMPTY },
      trails: { type: 'geojson', data: EMPTY, tolerance: 0.1 },
      pictures: { type: 'geojson', data: EMPTY },
      destinations: { type: 'geojson', data: EMPTY },
      ...(tiles && { tiles: { type: 'raster', tiles: [tiles], tileSize: 256, maxzoom: 19 } }),
    },
    layers: [
      { id: 'ground', type: 'background', paint: { 'background-color': colours.ground } },
      ...(tiles ? [{ id: 'tiles', type: 'raster', source: 'tiles' } satisfies LayerSpecification] : []),
      ...gridLayers(colours, tiles !== ''),
      ...pathLayers(),
      pictureLayer(colours),
      ...destinationLayers(colours),
    ],
  };
}

function gridLayers(colours: MapColours, onTiles: boolean): LayerSpecification[] {
  return [
    {
      id: 'grid',
      type: 'line',
      source: 'grid',
      paint: {
        'line-color': ['case', ['get', 'major'], colours.major, colours.minor],
        'line-width': ['case', ['get', 'major'], 1.2, 1],
        'line-opacity': onTiles ? 0.45 : 1,
      },
    },
    {
      id: 'grid-labels',
      type: 'symbol',
      source: 'grid',
      layout: {
        'symbol-placement': 'line',
        'symbol-spacing': 640,
        'text-field': ['get', 'label'],
        'text-font': ['system-ui', 'sans-serif'],
        'text-size': 11,
        'text-padding': 12,
      },
      paint: { 'text-color': colours.label, 'text-halo-color': colours.ground, 'text-halo-width': 2 },
    },
  ];
}

function pathLayers(): LayerSpecification[] {
  const round = { 'line-join': 'round', 'line-cap': 'round' } as const;
  const colour = ['get', 'colour'] as unknown as string;
  return [
    {
      id: 'plans',
      type: 'line',
      source: 'plans',
      filter: ['==', ['geometry-type'], 'LineString'],
      layout: { 'line-join': 'round' },
      paint: { 'line-color': colour, 'line-width': 1.6, 'line-dasharray': [3, 2.5], 'line-opacity': 0.75 },
    },
    {
      id: 'plan-points',
      type: 'circle',
      source: 'plans',
      minzoom: 15,
      paint: { 'circle-radius': 2.4, 'circle-color': colour, 'circle-opacity': 0.85 },
    },
    {
      id: 'trails',
      type: 'line',
      source: 'trails',
      layout: round,
      paint: { 'line-color': colour, 'line-width': 3, 'line-opacity': 0.55 },
    },
  ];
}

/** From a vehicle to where it was sent: cased, to be seen on any ground. */
function destinationLayers(colours: MapColours): LayerSpecification[] {
  const colour = ['get', 'colour'] as unknown as string;
  const line = { type: 'line', source: 'destinations', layout: { 'line-cap': 'round' } } as const;
  return [
    { id: 'destination-casings', ...line, paint: { 'line-color': colours.ground, 'line-width': 5, 'line-opacity': 0.8 } },
    { id: 'destinations', ...line, paint: { 'line-color': colour, 'line-width': 2.4 } },
  ];
}

function pictureLayer(colours: MapColours): LayerSpecification {
  return {
    id: 'pictures',
    type: 'circle',
    source: 'pictures',
    minzoom: 13,
    paint: {
      'circle-radius': 2.6,
      'circle-color': colours.ground,
      'circle-stroke-color': ['get', 'colour'] as unknown as string,
      'circle-stroke-width': 1.4,
    },
  };
}
