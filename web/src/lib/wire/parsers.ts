/** Of what parsers of data from outside are made: each gives the value, or nothing when it is not what it should be. */

export type Parse<T> = (value: unknown) => T | undefined;
export type Shape<T> = { [K in keyof T]-?: Parse<Exclude<T[K], undefined>> };

const LONGEST_TEXT = 20_000;
const LONGEST_LIST = 20_000;
/** Of tasks within tasks, and of data that is not known here. */
export const DEEPEST = 60;

export const flag: Parse<boolean> = (value) => (typeof value === 'boolean' ? value : undefined);
export const textUpTo =
  (limit: number): Parse<string> =>
  (value) =>
    typeof value === 'string' ? value.slice(0, limit) : undefined;
export const text = textUpTo(LONGEST_TEXT);
export const number =
  (low: number, high: number): Parse<number> =>
  (value) =>
    typeof value === 'number' && value >= low && value <= high ? value : undefined;
export const count = number(0, Number.MAX_SAFE_INTEGER);
export const share = number(0, 1);
export const seconds = number(0, 1e9);
export const metres = number(-1e7, 1e7);

export const orNull =
  <T>(item: Parse<T>): Parse<T | null> =>
  (value) =>
    value === null ? null : item(value);

/** One of the words; for others `otherwise`, where one is given. */
export function word<T extends string>(words: readonly T[], otherwise?: T): Parse<T> {
  return (value) => (words.includes(value as T) ? (value as T) : otherwise);
}

/** Those entries that can be read; of several with one key the first. */
export function list<T>(item: Parse<T>, keyOf?: (entry: T) => string | number): Parse<T[]> {
  return (value) => {
    if (!Array.isArray(value)) return undefined;
    const entries: T[] = [];
    const seen = new Set<string | number>();
    for (const one of value.slice(0, LONGEST_LIST)) {
      const entry = item(one);
      if (entry === undefined || (keyOf && seen.has(keyOf(entry)))) continue;
      if (keyOf) seen.add(keyOf(entry));
      entries.push(entry);
    }
    return entries;
  };
}

export const isObject = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** Data without any promise but that it is finite, not too deep and of a bearable size. */
function plain(value: unknown, depth = 0): unknown {
  if (typeof value === 'string') return text(value);
  if (typeof value === 'number') return Number.isFinite(value) ? value : undefined;
  if (typeof value === 'boolean') return value;
  if (depth >= DEEPEST) return undefined;
  if (Array.isArray(value))
    return value
      .slice(0, LONGEST_LIST)
      .map((one) => plain(one, depth + 1))
      .filter((one) => one !== undefined);
  if (!isObject(value)) return undefined;
  const entries = Object.entries(value).map(([key, one]): [string, unknown] => [key, plain(one, depth + 1)]);
  return Object.fromEntries(entries.filter(([key, one]) => key !== '__proto__' && one !== undefined));
}

/** An object of that shape; without one of the `needed` keys it is none. Other keys that cannot be read are left out. */
export function object<T extends object>(shape: Shape<T>, needed: readonly (keyof T)[]): Parse<T> {
  return (value) => {
    if (!isObject(value)) return undefined;
    const result: Record<string, unknown> = {};
    for (const [key, one] of Object.entries(value)) {
      if (key === '__proto__') continue;
      const parse = Object.hasOwn(shape, key) ? (shape as Record<string, Parse<unknown>>)[key]! : plain;
      const parsed = parse(one);
      if (parsed !== undefined) result[key] = parsed;
    }
    return needed.every((key) => Object.hasOwn(result, key)) ? (result as T) : undefined;
  };
}
