import { bodyOf, isObject } from '../lib/files/answers';
import { changesOf, type Changes } from './changes';

/** One run of a station whose past is kept. Times are ms since 1970. */
export interface KeptSession {
  id: string;
  name: string;
  began_ms: number;
  ended_ms: number;
}

/** A message as viewers got it at that time. */
export interface KeptFrame {
  at_ms: number;
  text: string;
}

export interface KeptPart {
  frames: KeptFrame[];
  /** Up to there none is missing. */
  complete_to_ms: number;
}

export interface KeptMoment {
  session: string;
  at_ms: number;
}

/** Asks the station over HTTP; nothing when it does not answer. */
export type Ask = (address: string) => Promise<Response | undefined>;

/** Why the past cannot be shown, in words for people. */
export class NoPast extends Error {}

/** What a station keeps of what it has shown. */
export class Archive {
  constructor(private readonly ask: Ask) {}

  /** The newest first. */
  async sessions(): Promise<KeptSession[]> {
    const { sessions } = await this.get('/api/v1/history');
    if (!Array.isArray(sessions)) throw new NoPast('The station does not say what it keeps.');
    return sessions.flatMap((one) => sessionOf(one) ?? []);
  }

  /** What brings an empty page to that moment. */
  async stateAt(session: string, at_ms: number): Promise<KeptFrame[]> {
    const { frames } = await this.get(`/api/v1/history/${encodeURIComponent(session)}/state?at_ms=${Math.round(at_ms)}`);
    return framesOf(frames);
  }

  async between(session: string, from_ms: number, to_ms: number): Promise<KeptPart> {
    const query = `from_ms=${Math.round(from_ms)}&to_ms=${Math.round(to_ms)}`;
    const { frames, complete_to_ms } = await this.get(`/api/v1/history/${encodeURIComponent(session)}/frames?${query}`);
    if (typeof complete_to_ms !== 'number') throw new NoPast('The station does not say how far its past goes.');
    return { frames: framesOf(frames), complete_to_ms };
  }

  /** What has changed from one moment to another, which may be of another session. */
  async changes(from: KeptMoment, to: KeptMoment): Promise<Changes> {
    const query = `from_ms=${Math.round(from.at_ms)}&to_session=${encodeURIComponent(to.session)}&to_ms=${Math.round(to.at_ms)}`;
    return changesOf(await this.get(`/api/v1/history/${encodeURIComponent(from.session)}/changes?${query}`));
  }

  private async get(address: string): Promise<Record<string, unknown>> {
    const { body, failure } = await bodyOf(await this.ask(address));
    if (failure) throw new NoPast(failure);
    return body;
  }
}

function sessionOf(value: unknown): KeptSession | undefined {
  if (!isObject(value)) return undefined;
  const { id, name, began_ms, ended_ms } = value;
  if (typeof id !== 'string' || typeof began_ms !== 'number' || typeof ended_ms !== 'number' || ended_ms < began_ms) return undefined;
  return { id, name: typeof name === 'string' ? name : '', began_ms, ended_ms };
}

function framesOf(value: unknown): KeptFrame[] {
  if (!Array.isArray(value)) return [];
  return value.flatMap((one: unknown) => {
    if (!isObject(one) || typeof one.at_ms !== 'number' || !isObject(one.message)) return [];
    return [{ at_ms: one.at_ms, text: JSON.stringify(one.message) }];
  });
}
