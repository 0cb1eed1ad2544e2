import type { LayerSpecification, Map as MapLibreMap } from 'maplibre-gl';
import { stationTiles } from '../map/station_tiles';
import type { Kind } from '../past/changes';
import { EMPTY, type MakeLayer } from './layer';

/** The same in both themes and as the station paints cells: who compares must not learn two. */
export const CHANGE_COLOURS: Record<Kind, string> = { added: '#0b8f4d', changed: '#e69f00', removed: '#d52b1e' };

const SOURCE = 'changes';
const colour = ['get', 'colour'] as unknown as string;

/** What has changed between two moments, over what is shown of the later one. */
export const changes: MakeLayer = ({ changes: compared, floors, session }) => {
  let drawn: readonly string[] = [];
  let lookedAt: object | undefined;

  function drop(map: MapLibreMap): void {
    for (const key of drawn) {
      if (map.getLayer(key)) map.removeLayer(key);
      if (map.getSource(key)) map.removeSource(key);
    }
    drawn = [];
  }

  return {
    id: 'changes',
    name: 'Changes',
    group: 'Tools',
    legend: [],
    sources: { [SOURCE]: EMPTY },
    layers: () => looks(),
    update({ generation, map, source }) {
      if (generation === 0) return;
      const { shown } = compared;
      const features = (shown?.features ?? []).filter(({ feature }) =>
        floors.isShown(feature as unknown as Parameters<typeof floors.isShown>[0]),
      );
      source(SOURCE)?.setData({
        type: 'FeatureCollection',
        features: features.map(({ kind, feature: { geometry } }) => ({
          type: 'Feature',
          geometry,
          properties: { colour: CHANGE_COLOURS[kind] },
        })),
      });
      drop(map);
      for (const { key, bounds, pictures } of shown?.grids ?? []) {
        stationTiles.set(key, pictures, (address) => session.ask(address));
        map.addSource(key, { type: 'raster', tiles: [stationTiles.address(key)], tileSize: 256, bounds });
        const paint = { 'raster-resampling': 'nearest', 'raster-fade-duration': 0 } as const;
        map.addLayer({ id: key, type: 'raster', source: key, paint }, 'changes-area');
        drawn = [...drawn, key];
      }
      if (compared.lookedAt && compared.lookedAt !== lookedAt) {
        const [west, south, east, north] = compared.lookedAt.bounds;
        map.fitBounds([west, south, east, north], { maxZoom: 21, padding: 80 }); // prettier-ignore
      }
      lookedAt = compared.lookedAt;
    },
  };
};

function looks(): LayerSpecification[] {
  return [
    {
      id: 'changes-area',
      type: 'fill',
      source: SOURCE,
      filter: ['==', ['geometry-type'], 'Polygon'],
      paint: { 'fill-color': colour, 'fill-opacity': 0.35 },
    },
    {
      id: 'changes-line',
      type: 'line',
      source: SOURCE,
      filter: ['!=', ['geometry-type'], 'Point'],
      paint: { 'line-color': colour, 'line-width': 4 },
    },
    {
      id: 'changes-point',
      type: 'circle',
      source: SOURCE,
      filter: ['==', ['geometry-type'], 'Point'],
      paint: {
        'circle-radius': 9,
        'circle-color': colour,
        'circle-opacity': 0.45,
        'circle-stroke-color': colour,
        'circle-stroke-width': 3,
      },
    },
  ];
}
