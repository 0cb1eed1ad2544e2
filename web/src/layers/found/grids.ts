import type { Map as MapLibreMap } from 'maplibre-gl';
import type { Frame } from '../../connection/frame';
import { stationTiles } from '../../map/station_tiles';
import { EMPTY, type MakeLayer } from '../layer';
import { tilesWithin, type LonLatBox } from './tile_span';

/** An occupancy grid of a floor: not its cells, but where its pictures are, and which part of them is new. */
export interface MapGrid {
  key: string;
  properties: { site: string; floor: string };
  bounds: LonLatBox;
  /** Address of its pictures as they are now, with {z}, {x} and {y}. */
  pictures: string;
  tiling: { origin: [number, number]; x: [number, number]; y: [number, number] };
  /** Since it was drawn. */
  changed: readonly (readonly [number, number])[];
  isNew: boolean;
  isDrawn: boolean;
}

/** Below what lies on the ground, so its looks are put under this one, which shows nothing. */
const MARK = 'grids-mark';

/** Occupancy grids as pictures that the station draws: each is asked for again when a part of it has changed. */
export const grids: MakeLayer = ({ feeds, floors, mapLayers, session }) => {
  const told = feeds.follow<ReadonlyMap<string, MapGrid>>('map.grids', new Map(), take);
  let drawn: ReadonlyMap<string, MapGrid> = new Map();
  let drawnOn = 0;
  let on: MapLibreMap | undefined;

  function show(map: MapLibreMap, grid: MapGrid, before: MapGrid | undefined, opacity: number): void {
    stationTiles.set(grid.key, session.addressThen(grid.pictures), (address) => session.ask(address));
    grid.isDrawn = true;
    const isSame = before && before.bounds.join() === grid.bounds.join();
    if (!isSame && map.getLayer(grid.key)) drop(map, grid.key);
    if (!map.getSource(grid.key)) {
      map.addSource(grid.key, { type: 'raster', tiles: [stationTiles.address(grid.key)], tileSize: 256, bounds: grid.bounds });
      const look = { 'raster-resampling': 'nearest', 'raster-fade-duration': 0, 'raster-opacity': opacity } as const;
      map.addLayer({ id: grid.key, type: 'raster', source: grid.key, paint: look }, MARK);
    } else if (before?.pictures !== grid.pictures) {
      refresh(map, grid);
    }
  }

  /** Of the pictures in view those on which something has changed. */
  function refresh(map: MapLibreMap, grid: MapGrid): void {
    if (grid.isNew) return map.refreshTiles(grid.key);
    const zoom = Math.floor(map.getZoom());
    const seen = map.getBounds();
    const view: LonLatBox = [seen.getWest(), seen.getSouth(), seen.getEast(), seen.getNorth()];
    const tiles = grid.changed.flatMap((cell) => tilesWithin(boundsOf(grid, cell), view, [zoom, zoom + 1]));
    const unique = new Map(tiles.map((tile) => [`${tile.z}/${tile.x}/${tile.y}`, tile]));
    if (unique.size > 0) map.refreshTiles(grid.key, [...unique.values()]);
  }

  function drop(map: MapLibreMap, key: string): void {
    if (map.getLayer(key)) map.removeLayer(key);
    if (map.getSource(key)) map.removeSource(key);
  }

  return {
    id: 'grids',
    name: 'Occupancy',
    group: 'Found',
    legend: [{ sign: 'grid', text: 'dark where something stands, or in a car park nobody parks; light elsewhere' }],
    sources: { [MARK]: EMPTY },
    layers: () => [{ id: MARK, type: 'line', source: MARK }],
    update({ generation, map }) {
      const { content } = told;
      const { opacity } = mapLayers.lookOf('grids');
      if (generation === 0) return;
      on = map;
      const isAnew = generation !== drawnOn;
      const shown = new Map([...content].filter(([, grid]) => floors.isShown(grid)));
      for (const key of drawn.keys()) if (!shown.has(key)) drop(map, key);
      for (const [key, grid] of shown) show(map, grid, isAnew ? undefined : drawn.get(key), opacity);
      for (const key of shown.keys()) map.setPaintProperty(key, 'raster-opacity', opacity);
      [drawn, drawnOn] = [shown, generation];
    },
    hide() {
      for (const key of drawn.keys()) if (on) drop(on, key);
      drawn = new Map();
    },
  };
};

export function take(grids: ReadonlyMap<string, MapGrid>, { content, whole }: Frame): ReadonlyMap<string, MapGrid> {
  if (content instanceof Uint8Array || content.type !== 'grids' || !Array.isArray(content.grids)) return grids;
  const next = new Map(whole ? [] : grids);
  for (const one of content.grids as unknown[]) {
    const grid = gridOf(one);
    if (grid) next.set(grid.key, following(grids.get(grid.key), grid));
  }
  return next;
}

/** What came before and has not been drawn yet is still to be drawn. */
function following(before: MapGrid | undefined, grid: MapGrid): MapGrid {
  if (!before || before.isDrawn) return grid;
  return { ...grid, isNew: grid.isNew || before.isNew, changed: [...before.changed, ...grid.changed] };
}

function gridOf(value: unknown): MapGrid | undefined {
  const told = (value ?? {}) as Record<string, unknown>;
  const { site, floor, name, bounds, pictures, tiling, changed, full } = told;
  if (typeof site !== 'string' || typeof floor !== 'string' || typeof pictures !== 'string' || !isBox(bounds)) return undefined;
  const cells = Array.isArray(changed) ? (changed as [number, number][]) : [];
  return {
    key: `grid ${site} ${floor} ${String(name)}`,
    properties: { site, floor },
    bounds,
    pictures,
    tiling: tiling as MapGrid['tiling'],
    changed: cells,
    isNew: full === true,
    isDrawn: false,
  };
}

function isBox(value: unknown): value is LonLatBox {
  return Array.isArray(value) && value.length === 4 && value.every((number) => typeof number === 'number');
}

/** Of a tile of cells: its corners by two steps from the corner of the first. */
function boundsOf({ tiling: { origin, x, y } }: MapGrid, [column, row]: readonly [number, number]): LonLatBox {
  const corners = [0, 1].flatMap((i) =>
    [0, 1].map((j) => [0, 1].map((axis) => origin[axis]! + (column + i) * x[axis]! + (row + j) * y[axis]!)),
  );
  const [lons, lats] = [corners.map(([lon]) => lon!), corners.map(([, lat]) => lat!)];
  return [Math.min(...lons), Math.min(...lats), Math.max(...lons), Math.max(...lats)];
}
