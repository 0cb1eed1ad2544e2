import { expect, it } from 'vitest';
import type { Frame } from '../connection/frame';
import type { MakeLayer } from '../layers/layer';
import { TestStation } from '../testing/station';

/** A layer as a file of src/layers has it: cells of a grid that come as bytes, one number each. */
const cells: MakeLayer = ({ feeds }) => {
  const known = feeds.follow<number[]>('cells', [], (before, { content }: Frame) => [...before, ...(content as Uint8Array)]);
  return {
    id: 'cells',
    name: 'Cells',
    group: 'Found',
    legend: [],
    sources: {},
    layers: () => [],
    update: ({ source }) => void source(known.content.join()),
  };
};

const FEEDS = [
  { name: 'vehicles', id: 1 },
  { name: 'cells', id: 2 },
];

function drawn(layer: ReturnType<MakeLayer>): string {
  let text = '';
  layer.update({ source: (what: string) => void (text = what) } as unknown as Parameters<typeof layer.update>[0]);
  return text;
}

const bytes = (revision: number, whole: boolean, ...values: number[]): ArrayBuffer =>
  new Uint8Array([1, whole ? 1 : 0, 2, 0, 0, 0, 0, 0, revision, 0, 0, 0, 0, 0, 0, 0, ...values]).buffer;

it('gives a layer the feed that it names, and asks the station for it', () => {
  const station = TestStation.live([], { run: 'a', feeds: FEEDS });
  expect(station.subscribed).toEqual(['vehicles']);
  const layer = cells(station.stores);
  expect(station.subscribed).toEqual(['vehicles', 'cells']);
  station.tellBytes(bytes(1, true, 3, 4));
  station.tellBytes(bytes(2, false, 5));
  expect(drawn(layer)).toBe('3,4,5');
  expect(drawn(cells(station.stores))).toBe('3,4,5');
  station.tellBytes(bytes(3, true, 6));
  expect(drawn(layer)).toBe('6');
});

it('gives each store the messages of its feeds alone, and everybody those of none', () => {
  const station = TestStation.live([], { run: 'a', feeds: FEEDS });
  const trees = [{ id: 1, kind: 'mission', label: '', line: 1, state: 'running' as const }];
  station.tell({ type: 'tasks', trees, feed: 'weather', revision: 1 } as Parameters<typeof station.tell>[0]);
  expect(station.stores.scripts.trees).toEqual([]);
  station.tell({ type: 'tasks', trees, feed: 'tasks', revision: 1 } as Parameters<typeof station.tell>[0]);
  expect(station.stores.scripts.trees).toHaveLength(1);
});

it('has pictures as one of them', async () => {
  URL.createObjectURL = () => ''; // MapLibre asks for it as soon as it is loaded
  const { pictures } = await import('../layers/pictures');
  const station = TestStation.live();
  const layer = pictures(station.stores);
  let marks = 0;
  const draw = (): number => {
    const setData = (data: { features: unknown[] }): number => (marks = data.features.length);
    const drawing = { generation: 1, colourOf: () => 'red', source: () => ({ setData }) };
    layer.update(drawing as unknown as Parameters<typeof layer.update>[0]);
    return marks;
  };
  const picture = (number: number) => ({ number, lat_deg: 1, lon_deg: 2, alt_m: 3, relative_alt_m: 4 });
  const told = (number: number, full: boolean) =>
    station.tell({ type: 'pictures', vehicle: '1', full, pictures: [picture(number)], feed: 'pictures', revision: number } as Parameters<
      typeof station.tell
    >[0]);
  told(1, true);
  told(2, false);
  expect(draw()).toBe(2);
  told(3, true);
  expect(draw()).toBe(1);
});
