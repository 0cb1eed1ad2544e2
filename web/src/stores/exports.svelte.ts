import { bodyOf, isObject } from '../lib/files/answers';
import { sentences } from '../lib/format';
import { saveFile } from '../lib/files/save_file';
import type { Session } from './session.svelte';

/** As what the map can be written. */
export interface ExportFormat {
  name: string;
  extension: string;
  features: boolean;
  grids: boolean;
  pictures: boolean;
  note: string;
}

/** What shall be in the file. */
export interface ExportWish {
  format: string;
  layers?: readonly string[];
  site?: string;
  floor?: string;
  within_deg?: readonly [number, number, number, number];
  scale?: number;
}

const PAUSE_MS = 300;

/** Has the station write files of the map, and fetches them. */
export class ExportsStore {
  formats = $state.raw<readonly ExportFormat[]>([]);
  /** Why there are none; empty: there are, or nobody has asked. */
  missing = $state('');
  /** Of what is being written, from 0 to 1. */
  progress = $state<number | undefined>();
  /** What became of the last one. */
  outcome = $state('');
  failure = $state('');
  private running = '';

  constructor(
    private readonly session: Session,
    private readonly save: typeof saveFile = saveFile,
  ) {}

  async ask(): Promise<void> {
    const { body, failure } = await bodyOf(await this.session.ask('/api/v1/exports'));
    this.formats = Array.isArray(body.formats) ? body.formats.filter(isFormat) : [];
    const why = sentences(body.reason, body.hint);
    this.missing = this.formats.length > 0 ? '' : failure || why || 'This station writes no files of the map.';
  }

  async start(wish: ExportWish): Promise<void> {
    if (this.progress !== undefined) return;
    [this.outcome, this.failure, this.progress] = ['', '', 0];
    this.failure = await this.carryOut(wish);
    this.progress = undefined;
    this.running = '';
  }

  async stop(): Promise<void> {
    const id = this.running;
    this.running = '';
    if (id) await this.session.ask(`/api/v1/exports/${id}`, { method: 'DELETE' });
  }

  /** Why there is no file; empty when there is one, or nobody wants it any more. */
  private async carryOut(wish: ExportWish): Promise<string> {
    const headers = { 'Content-Type': 'application/json' };
    const asked = await bodyOf(await this.session.ask('/api/v1/exports', { method: 'POST', headers, body: JSON.stringify(wish) }));
    const id = asked.body.id;
    if (asked.failure || typeof id !== 'string') return asked.failure || 'The station does not say what it does.';
    const address = `/api/v1/exports/${id}`;
    this.running = id;
    for (;;) {
      const { body, failure } = await bodyOf(await this.session.ask(address));
      if (this.running !== id) return '';
      if (failure) return failure;
      if (body.state === 'failed') return sentences(body.reason, body.hint);
      if (body.state === 'done') return this.fetch(address, String(body.name));
      this.progress = typeof body.progress === 'number' ? body.progress : 0;
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    }
  }

  private async fetch(address: string, name: string): Promise<string> {
    const answer = await this.session.ask(`${address}/file`);
    if (!answer?.ok) return (await bodyOf(answer)).failure;
    const content = await answer.blob();
    this.save(name, content);
    this.outcome = `${name} is saved (${sizeText(content.size)}).`;
    void this.session.ask(address, { method: 'DELETE' });
    return '';
  }
}

export function sizeText(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  return bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

function isFormat(value: unknown): value is ExportFormat {
  if (!isObject(value)) return false;
  const { name, extension, note, features, grids, pictures } = value;
  return (
    [name, extension, note].every((one) => typeof one === 'string') && [features, grids, pictures].every((one) => typeof one === 'boolean')
  );
}
