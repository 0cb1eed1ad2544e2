import { render, screen, waitFor } from '@testing-library/svelte';
import { userEvent } from '@testing-library/user-event';
import { beforeEach, expect, it, vi } from 'vitest';
import { ExportsStore, sizeText } from '../../stores/exports.svelte';
import type { Session } from '../../stores/session.svelte';
import { contextOf } from '../../stores/stores';
import { TestStation } from '../../testing/station';
import ExportPanel from './ExportPanel.svelte';

const FORMATS = [
  { name: 'geopackage', extension: '.gpkg', features: true, grids: false, pictures: false, note: 'every layer whole' },
  { name: 'geotiff', extension: '.zip', features: false, grids: true, pictures: true, note: 'cloud optimized' },
  { name: 'pdf', extension: '.pdf', features: true, grids: true, pictures: false, note: 'a floor on paper' },
];
const json = (body: unknown, status = 200): Response => new Response(JSON.stringify(body), { status });

/** A station that answers as it is told, by "METHOD path". */
class Answers {
  readonly asked: string[] = [];
  readonly bodies: unknown[] = [];
  readonly by = new Map<string, (() => Response)[]>();
  readonly session = {
    ask: (address: string, { method = 'GET', body }: RequestInit = {}) => {
      const what = `${method} ${address.replace('/api/v1/exports', '')}`;
      this.asked.push(what);
      if (body) this.bodies.push(JSON.parse(body as string));
      const answers = this.by.get(what);
      const next = answers && (answers.length > 1 ? answers.shift() : answers[0]);
      return Promise.resolve(next?.());
    },
  } as unknown as Session;
  on(what: string, ...answers: (() => Response)[]): this {
    this.by.set(what, answers);
    return this;
  }
}

let answers: Answers;
let saved: { name: string; size: number }[];
const open = (): ExportsStore => {
  const station = TestStation.live();
  const exports = new ExportsStore(answers.session, (name, { size }) => saved.push({ name, size }));
  render(ExportPanel, {
    props: { inSight: () => ({ west: -181, south: 46, east: -179, north: 47 }) },
    context: contextOf({ ...station.stores, exports }),
  });
  return exports;
};

beforeEach(() => {
  answers = new Answers().on('GET ', () => json({ available: true, formats: FORMATS }));
  saved = [];
});

it('has the station write what is chosen, tells how far it is, and saves the file', async () => {
  vi.useFakeTimers({ shouldAdvanceTime: true });
  answers
    .on('POST ', () => json({ id: 'a1', state: 'running', progress: 0 }, 202))
    .on(
      'GET /a1',
      () => json({ id: 'a1', state: 'running', progress: 0.5, name: 'x' }),
      () => json({ id: 'a1', state: 'done', progress: 1, name: 'lapwing.gpkg' }),
    )
    .on('GET /a1/file', () => new Response('GeoPackage'));
  open();
  await userEvent.click(await screen.findByRole('checkbox', { name: 'Tracks' }));
  await userEvent.click(screen.getByRole('checkbox', { name: /in sight/ }));
  await userEvent.click(screen.getByRole('button', { name: 'Export' }));
  await waitFor(() => expect(screen.getByRole('progressbar')).toHaveValue(0.5));
  await screen.findByText('lapwing.gpkg is saved (10 B).');
  expect(saved).toEqual([{ name: 'lapwing.gpkg', size: 10 }]);
  expect(answers.bodies).toEqual([
    {
      format: 'geopackage',
      layers: ['slots', 'walls', 'points_of_interest', 'pictures', 'areas'],
      within_deg: [179, 46, -179, 47],
    },
  ]);
  await waitFor(() => expect(answers.asked.at(-1)).toBe('DELETE /a1'));
  vi.useRealTimers();
});

it('tells why there is no file, and what to do', async () => {
  answers.on('POST ', () => json({ detail: '2 exports run already.', hint: 'Wait.' }, 429));
  open();
  await userEvent.click(await screen.findByRole('button', { name: 'Export' }));
  await screen.findByText('2 exports run already. Wait.');
  answers
    .on('POST ', () => json({ id: 'b2' }, 202))
    .on('GET /b2', () => json({ state: 'failed', reason: 'there is nothing in the map that geotiff holds', hint: '' }));
  await userEvent.click(screen.getByRole('button', { name: 'Export' }));
  await screen.findByText('there is nothing in the map that geotiff holds.');
  expect(saved).toEqual([]);
});

it('can be stopped', async () => {
  answers
    .on('POST ', () => json({ id: 'c3' }, 202))
    .on('GET /c3', () => json({ state: 'running', progress: 0.1 }))
    .on('DELETE /c3', () => new Response(null, { status: 204 }));
  open();
  await userEvent.click(await screen.findByRole('button', { name: 'Export' }));
  await userEvent.click(await screen.findByRole('button', { name: 'Stop' }));
  await screen.findByRole('button', { name: 'Export' });
  expect(answers.asked).toContain('DELETE /c3');
  expect(screen.getByRole('alert').textContent).toBe('');
});

it('says what a station lacks that writes no files', async () => {
  answers.on('GET ', () => json({ available: false, formats: [], reason: 'lapwing-map is not there.', hint: 'Install GDAL.' }));
  open();
  await screen.findByText('lapwing-map is not there. Install GDAL.');
  answers.on('GET ', () => json({ available: true, formats: FORMATS }));
  await userEvent.click(screen.getByRole('button', { name: 'Look again' }));
  await screen.findByRole('button', { name: 'Export' });
});

it('asks for no layers where a format holds none, and for a scale on paper', async () => {
  open();
  await userEvent.selectOptions(await screen.findByRole('combobox', { name: 'As' }), 'geotiff');
  expect(screen.queryByRole('checkbox', { name: 'Walls' })).toBeNull();
  await userEvent.selectOptions(screen.getByRole('combobox', { name: 'As' }), 'pdf');
  expect(screen.getByRole('spinbutton')).toHaveValue(100);
});

it('tells sizes as people do', () => {
  expect([999, 1500, 12_300_000].map(sizeText)).toEqual(['999 B', '1.5 kB', '12.3 MB']);
});
