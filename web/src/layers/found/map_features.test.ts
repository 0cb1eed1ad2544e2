import { describe, expect, it } from 'vitest';
import { DrawnFeatures, take, type MapFeature, type MapFeatures } from './map_features';

const slot = (id: string, state: string): MapFeature => ({
  type: 'Feature',
  id,
  geometry: { type: 'Point', coordinates: [1, 2] },
  properties: { state },
});
const tell = (features: MapFeatures, content: Record<string, unknown>): MapFeatures =>
  take(features, { content: { type: 'features', ...content } });

describe('features as the station tells them', () => {
  it('come whole, change and go', () => {
    const whole = tell(new Map([['old', slot('old', 'free')]]), { full: true, features: [slot('a', 'free'), slot('b', 'free')] });
    expect([...whole.keys()]).toEqual(['a', 'b']);
    const later = tell(whole, { full: false, features: [slot('b', 'taken')], removed: ['a'] });
    expect([...later.keys()]).toEqual(['b']);
    expect(later.get('b')?.properties.state).toBe('taken');
  });

  it('lose what is none of them', () => {
    const bad = [
      null,
      3,
      {},
      { id: 1 },
      { id: 'x', properties: {}, geometry: { type: 'Circle', coordinates: [] } },
      { id: 'y', properties: {} },
    ];
    expect(tell(new Map(), { full: true, features: [...bad, slot('a', 'free')] }).size).toBe(1);
    expect(tell(new Map(), { full: true, features: 'all' }).size).toBe(0);
  });
});

describe('drawing them', () => {
  it('tells the map the difference alone', () => {
    const told: unknown[] = [];
    const source = { setData: (data: unknown) => told.push(data), updateData: (data: unknown) => told.push(data) } as never;
    const drawn = new DrawnFeatures();
    const first: MapFeatures = new Map([['a', slot('a', 'free')], ['b', slot('b', 'free')]]); // prettier-ignore
    drawn.show(source, 1, first);
    expect(told).toHaveLength(1);
    const second = tell(first, { full: false, features: [slot('b', 'taken')], removed: ['a'] });
    drawn.show(source, 1, second);
    expect(told[1]).toMatchObject({ remove: ['a'], add: [{ id: 'b', properties: { state: 'taken', id: 'b' } }] });
    drawn.show(source, 1, second);
    expect(told).toHaveLength(2);
    drawn.show(source, 1, new Map());
    expect(told[2]).toMatchObject({ remove: ['b'], add: [] });
    drawn.show(source, 2, second);
    expect(told[3]).toMatchObject({ type: 'FeatureCollection' });
  });
});
