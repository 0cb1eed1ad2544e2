import type { ImageSource, Map as MapLibreMap } from 'maplibre-gl';
import { pictureCorners } from '../../lib/places/ground';
import { stationTiles } from '../../map/station_tiles';
import { isPlan } from '../../stores/placing.svelte';
import { featuresOf } from '../features';
import { BOLD, EMPTY, type MakeLayer } from '../layer';
import { followFeatures, type MapFeature } from './map_features';

type Corners = [[number, number], [number, number], [number, number], [number, number]];
/** One that is drawn: what of, and where. */
interface Sheet {
  image: string;
  corners: Corners;
}

/** Pictures lie below the points by which one is being placed. */
const MARK = 'plan-marks';
/** More are not drawn at once: who has so many looks at a floor of them. */
const MOST = 24;
const PLACING = 'plan being placed';

/** Floor plans and other pictures that somebody has laid on the ground, and the one that is being laid there. */
export const floorPlans: MakeLayer = ({ feeds, floors, mapLayers, placing, session }) => {
  const pictures = followFeatures(feeds, 'pictures');
  let drawn = new Map<string, Sheet>();
  let drawnOn = 0;
  let on: MapLibreMap | undefined;
  let marks = '';

  function sheets(): Map<string, Sheet> {
    const plans = [...pictures.content.values()].filter((one) => isPlan(one) && floors.isShown(one) && one.id !== placing.id);
    const all = new Map(plans.slice(0, MOST).flatMap((plan) => sheetOf(plan)));
    const { picture, corners, round } = placing;
    if (picture && corners) all.set(PLACING, { image: `placing ${round}`, corners: corners as Corners });
    return all;
  }

  function show(map: MapLibreMap, key: string, { image, corners }: Sheet, before: Sheet | undefined): void {
    if (before && before.image !== image) drop(map, key);
    const name = `picture ${image}`;
    const { picture } = placing;
    if (key === PLACING && picture) stationTiles.set(name, '', () => Promise.resolve(new Response(picture.bytes)));
    else stationTiles.set(name, `/api/v1/blobs/${image}`, (address) => session.ask(address));
    const source = map.getSource<ImageSource>(key);
    if (source) {
      if (before?.corners.join() !== corners.join()) source.setCoordinates(corners);
      return;
    }
    map.addSource(key, { type: 'image', url: stationTiles.address(name).replace('{z}/{x}/{y}', '0/0/0'), coordinates: corners });
    map.addLayer({ id: key, type: 'raster', source: key, paint: { 'raster-fade-duration': 0 } }, MARK);
  }

  return {
    id: 'floor_plans',
    name: 'Floor plans',
    group: 'Ground',
    legend: [{ sign: 'area', text: 'a plan or picture that somebody has laid on the ground' }],
    sources: { [MARK]: EMPTY },
    layers: ({ accent, panel, text }) => [
      {
        id: MARK,
        type: 'circle',
        source: MARK,
        paint: { 'circle-radius': 5, 'circle-color': panel, 'circle-stroke-color': accent, 'circle-stroke-width': 2.5 },
      },
      {
        id: 'plan-mark-numbers',
        type: 'symbol',
        source: MARK,
        layout: {
          'text-field': ['get', 'text'],
          'text-font': BOLD,
          'text-size': 13,
          'text-offset': [0.9, -0.7],
          'text-allow-overlap': true,
        },
        paint: { 'text-color': text, 'text-halo-color': panel, 'text-halo-width': 2 },
      },
    ],
    update({ generation, map, source }) {
      const wanted = sheets();
      const { opacity } = mapLayers.lookOf('floor_plans');
      const { pairs } = placing;
      if (generation === 0) return;
      on = map;
      const isAnew = generation !== drawnOn;
      for (const key of drawn.keys()) if (!wanted.has(key)) drop(map, key);
      for (const [key, sheet] of wanted) show(map, key, sheet, isAnew ? undefined : drawn.get(key));
      // What is being placed lets through what it is placed by.
      for (const key of wanted.keys()) map.setPaintProperty(key, 'raster-opacity', key === PLACING ? 0.6 * opacity : opacity);
      const now = `${generation} ${JSON.stringify(pairs)}`;
      if (now !== marks)
        source(MARK)?.setData(
          featuresOf(pairs.map(({ at }, index) => ({ properties: { text: String(index + 1) }, point: [at.lon_deg, at.lat_deg] }))),
        );
      [drawn, drawnOn, marks] = [wanted, generation, now];
    },
    hide() {
      for (const key of drawn.keys()) if (on) drop(on, key);
      drawn = new Map();
    },
  };
};

function drop(map: MapLibreMap, key: string): void {
  if (map.getLayer(key)) map.removeLayer(key);
  if (map.getSource(key)) map.removeSource(key);
}

function sheetOf({ id, geometry, properties }: MapFeature): [string, Sheet][] {
  const ring = geometry.type === 'Polygon' ? geometry.coordinates[0] : undefined;
  const corners = ring && pictureCorners(ring);
  return corners ? [[`plan ${id}`, { image: String(properties.image), corners }]] : [];
}
