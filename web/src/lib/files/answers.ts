import { sentences } from '../format';

type Body = Readonly<Record<string, unknown>>;

export function isObject(value: unknown): value is Body {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** What the station answered over HTTP, or in words for people why it did not. */
export async function bodyOf(answer: Response | undefined): Promise<{ body: Body; failure: string }> {
  if (!answer) return { body: {}, failure: 'The station does not answer.' };
  const value: unknown = await answer.json().catch(() => undefined);
  const body = isObject(value) ? value : {};
  if (answer.ok) return { body, failure: '' };
  const words = sentences(body.detail, body.hint);
  return { body, failure: words || `The station refuses (${answer.status}).` };
}
