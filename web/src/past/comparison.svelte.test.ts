import { render, screen, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { flushSync } from 'svelte';
import { afterEach, describe, expect, it } from 'vitest';
import { TestStation } from '../testing/station';
import { Archive } from './archive';
import { boundsOf } from './changes';
import ChangesPanel from './ChangesPanel.svelte';
import { Comparison } from './comparison.svelte';
import { Player } from './player.svelte';

const feature = (id: string, properties: object, lon = 8) => ({
  type: 'Feature',
  id,
  geometry: { type: 'Point', coordinates: [lon, 47] },
  properties,
});

const answer = {
  left_out: 2,
  layers: [
    {
      layer: 'slots',
      added: [feature('a', { name: 'A 1' }), { id: 'no feature' }],
      removed: [feature('b', {})],
      changed: [{ before: feature('c', { state: 'free' }), after: feature('c', { state: 'taken' }, 9), properties: ['geometry', 'state'] }],
    },
  ],
  grids: [
    {
      site: 'yard',
      floor: '',
      name: 'ground',
      bounds: [8, 47, 8.1, 47.1],
      pictures: '/changes/{z}/{x}/{y}.png',
      taken: 3,
      freed: 2,
      other: 1,
    },
    { name: 'no grid' },
  ],
};
const sessions = [
  { id: 'new', name: '', began_ms: 100_000, ended_ms: 200_000 },
  { id: 'old', name: '', began_ms: 1_000, ended_ms: 2_000 },
];

let station: TestStation;
afterEach(() => station.end());

async function comparing(given: object = answer) {
  station = TestStation.live();
  const { changes } = station.stores;
  const asked: string[] = [];
  const archive = new Archive((address) => {
    asked.push(address);
    const isChanges = address.includes('/changes?');
    return Promise.resolve(
      Response.json(isChanges ? given : { sessions, frames: [], complete_to_ms: 0 }, {
        status: 'detail' in given && isChanges ? 500 : 200,
      }),
    );
  });
  const player = new Player(archive, { name: 'yard' });
  const comparison = new Comparison(archive, player, (found) => changes.show(found));
  await player.open(150_000);
  comparison.begin();
  return { asked, player, comparison, changes };
}

describe('comparing two moments', () => {
  it('asks for what has changed from the earlier to the later one', async () => {
    const { asked, player, comparison } = await comparing();
    await player.seek(180_000);
    await comparison.compare();
    expect(asked.at(-1)).toBe('/api/v1/history/new/changes?from_ms=150000&to_session=new&to_ms=180000');
    await player.seek(120_000);
    await comparison.compare();
    expect(asked.at(-1)).toBe('/api/v1/history/new/changes?from_ms=120000&to_session=new&to_ms=150000');
  });

  it('compares with another session, and with now', async () => {
    const { asked, player, comparison } = await comparing();
    await player.choose('old');
    comparison.begin();
    await comparison.compareWithNow();
    await comparison.compare();
    expect(asked.at(-1)).toBe('/api/v1/history/old/changes?from_ms=1000&to_session=new&to_ms=200000');
  });

  it('asks nothing while the past is played', async () => {
    const { asked, player, comparison } = await comparing();
    player.togglePlaying();
    const before = asked.length;
    await comparison.compare();
    expect(asked.slice(before).filter((address) => address.includes('changes'))).toEqual([]);
  });

  it('lists what was added, changed and removed, and looks at what is clicked', async () => {
    const { comparison, changes } = await comparing();
    await comparison.compare();
    render(ChangesPanel, { props: { comparison }, context: station.context });
    expect(screen.getByText('1 added')).toBeInTheDocument();
    expect(screen.getByText('1 changed')).toBeInTheDocument();
    expect(screen.getByText('1 removed')).toBeInTheDocument();
    expect(screen.getByText('and 2 more, on the map only in part')).toBeInTheDocument();
    const changed = screen.getByRole('button', { name: /changed slot c/ });
    expect(within(changed).getByText('state: free → taken')).toBeInTheDocument();
    await userEvent.setup().click(changed);
    expect(changes.lookedAt).toEqual({ bounds: [9, 47, 9, 47] });
    expect(screen.getByRole('button', { name: /Grid ground/ })).toHaveTextContent('3 cells taken, 2 not any more, 1 otherwise');
    await userEvent.setup().click(screen.getByRole('button', { name: 'End the comparison' }));
    expect(changes.shown).toBeUndefined();
  });

  it('says that nothing has changed, and why it cannot tell', async () => {
    const nothing = await comparing({ layers: [], grids: [], left_out: 0 });
    await nothing.comparison.compare();
    const { unmount } = render(ChangesPanel, { props: { comparison: nothing.comparison }, context: station.context });
    expect(screen.getByText('Nothing has changed.')).toBeInTheDocument();
    unmount();
    station.end();
    const broken = await comparing({ detail: 'The disk is gone.' });
    await broken.comparison.compare();
    flushSync();
    render(ChangesPanel, { props: { comparison: broken.comparison }, context: station.context });
    expect(screen.getByRole('alert')).toHaveTextContent('The disk is gone.');
  });
});

it('finds the rectangle round anything', () => {
  expect(boundsOf({ type: 'Polygon', coordinates: [[[1, 2], [3, 2], [3, 5], [1, 2]]] })).toEqual([1, 2, 3, 5]); // prettier-ignore
});
