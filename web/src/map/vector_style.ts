import type { LayerSpecification } from 'maplibre-gl';

/** What a plain map shows of vector tiles, the lowest first. */
const KINDS = ['land', 'water', 'building', 'road', 'boundary', 'place'] as const;
type Kind = (typeof KINDS)[number];

/** By what the layers of the schemas in use are called (OpenMapTiles, Shortbread, Protomaps, Mapbox Streets, Tilezen). */
const NAMES: readonly [Kind, RegExp][] = [
  ['place', /place|poi|label|name|mountain_peak|housenumber|address/],
  ['water', /water|ocean|sea|river/],
  ['building', /building/],
  ['road', /road|street|transport|highway|rail|path|ferr|aeroway|bridge|pier|dam/],
  ['boundary', /boundar|admin/],
];

/** Of a layer that is called like none of them: ground of some kind. */
export function kindOf(layer: string): Kind {
  const name = layer.toLowerCase();
  return NAMES.find(([, pattern]) => pattern.test(name))?.[0] ?? 'land';
}

interface Look {
  fill: string;
  line: string;
  width: number;
}
interface Palette extends Record<Exclude<Kind, 'place'>, Look> {
  text: string;
  halo: string;
}

const DAY: Palette = {
  land: { fill: '#e3eadb', line: '#cfd8c6', width: 0.6 },
  water: { fill: '#bcd7e6', line: '#8fb9cf', width: 1 },
  building: { fill: '#ddd5ca', line: '#b9ae9f', width: 0.7 },
  road: { fill: '#e9e9e9', line: '#a9b0b6', width: 1.6 },
  boundary: { fill: '#00000000', line: '#9a8fb0', width: 1 },
  text: '#46525b',
  halo: '#ffffff',
};
const NIGHT: Palette = {
  land: { fill: '#17221c', line: '#22302a', width: 0.6 },
  water: { fill: '#12303f', line: '#1f4d63', width: 1 },
  building: { fill: '#2c2925', line: '#464038', width: 0.7 },
  road: { fill: '#22292f', line: '#4d5860', width: 1.6 },
  boundary: { fill: '#00000000', line: '#5d5472', width: 1 },
  text: '#a9b5bd',
  halo: '#0c1318',
};

/** Looks of our own for vector tiles of any schema: what each layer is follows from its name. */
export function vectorLooks(source: string, layers: readonly string[], isDark: boolean): LayerSpecification[] {
  const palette = isDark ? NIGHT : DAY;
  const sorted = [...layers].sort((a, b) => KINDS.indexOf(kindOf(a)) - KINDS.indexOf(kindOf(b)));
  const of = (layer: string): object => ({ source, 'source-layer': layer });
  const shapes = sorted.flatMap((layer): unknown[] => {
    const kind = kindOf(layer);
    if (kind === 'place') return [];
    const { fill, line, width } = palette[kind];
    return [
      ...(kind === 'boundary'
        ? []
        : [
            {
              ...of(layer),
              id: `base-fill-${layer}`,
              type: 'fill',
              filter: ['==', ['geometry-type'], 'Polygon'],
              paint: { 'fill-color': fill },
            },
          ]),
      {
        ...of(layer),
        id: `base-line-${layer}`,
        type: 'line',
        filter: ['match', ['geometry-type'], kind === 'boundary' ? ['LineString'] : ['LineString', 'Polygon'], true, false],
        layout: { 'line-cap': 'round', 'line-join': 'round' },
        paint: { 'line-color': line, 'line-width': width, ...(kind === 'boundary' && { 'line-dasharray': [3, 2] }) },
      },
    ];
  });
  const names = sorted.map((layer) => ({
    ...of(layer),
    id: `base-name-${layer}`,
    type: 'symbol',
    filter: ['any', ['has', 'name:latin'], ['has', 'name']],
    layout: {
      'text-field': ['coalesce', ['get', 'name:latin'], ['get', 'name']],
      'text-font': ['system-ui', 'sans-serif'],
      'text-size': 11.5,
      ...(kindOf(layer) === 'road' && { 'symbol-placement': 'line' }),
      'text-max-width': 8,
    },
    paint: { 'text-color': palette.text, 'text-halo-color': palette.halo, 'text-halo-width': 1.2 },
  }));
  return [...shapes, ...names] as LayerSpecification[];
}
