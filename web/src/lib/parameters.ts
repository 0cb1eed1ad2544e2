import { sentences } from './format';

/** A vehicle's parameters as the station's API gives them (docs/reference/openapi.yaml), and what the panel makes of them. */

export interface Parameter {
  name: string;
  /** null: no finite number. */
  value: number | null;
  /** As MAVLink calls it: int32, real32. */
  type: string;
}

export interface ParameterList {
  vehicle: string;
  confirmed: 'vehicle' | 'hash' | 'no';
  taken: string;
  parameters: Parameter[];
}

export interface Progress {
  fetching: boolean;
  done?: number;
  total?: number;
}

/** SERVO2 before SERVO10. */
const byName = new Intl.Collator('en', { numeric: true });

/** Those whose name holds every word; * stands for anything. In the order of the alphabet, as people look for them. */
export function filtered(parameters: readonly Parameter[], words: string): Parameter[] {
  const patterns = words
    .trim()
    .split(/\s+/)
    .map((word) => new RegExp(word.replace(/[.+?^${}()|[\]\\]/g, '\\$&').replaceAll('*', '.*'), 'i'));
  return parameters.filter(({ name }) => patterns.every((pattern) => pattern.test(name))).sort((a, b) => byName.compare(a.name, b.name));
}

const RANGES: Record<string, [number, number]> = {
  uint8: [0, 255],
  int8: [-128, 127],
  uint16: [0, 65535],
  int16: [-32768, 32767],
  uint32: [0, 2 ** 32 - 1],
  int32: [-(2 ** 31), 2 ** 31 - 1],
};
const LARGEST_FLOAT = 3.4028234663852886e38;

/** The number in a text, or why the parameter cannot have it. A point or a comma before the fraction. */
export function parseValue(text: string, type: string): { value: number } | { problem: string } {
  const plain = text.trim().replace(/^([+-]?\d*),(\d+)$/, '$1.$2');
  const value = Number(plain);
  if (plain === '' || !Number.isFinite(value)) return { problem: 'This is no number.' };
  const range = RANGES[type];
  if (!range) return Math.abs(value) > LARGEST_FLOAT ? { problem: 'This is too large.' } : { value };
  if (!Number.isInteger(value)) return { problem: 'This parameter is an integer.' };
  if (value < range[0] || value > range[1]) return { problem: `This parameter holds ${range[0]} to ${range[1]}.` };
  return { value };
}

export function valueText({ value }: { value: number | null }): string {
  return value === null ? 'no number' : String(value);
}

/** "RTL_ALT is 2000 now, was 1500." */
export function outcomeText(set: Parameter & { before: number | null }): string {
  const before = valueText({ value: set.before });
  return before === valueText(set)
    ? `${set.name} is ${valueText(set)}, as it was.`
    : `${set.name} is ${valueText(set)} now, was ${before}.`;
}

/** "312 of 1004", nothing while the total is not known. */
export function progressText({ done = 0, total = 0 }: Progress): string {
  return total > 0 ? `${done} of ${total}` : '';
}

/** What a refused request says to people. */
export function problemText(status: number | undefined, body: unknown): string {
  if (status === undefined) return 'The station did not answer.';
  const { detail, hint } = (typeof body === 'object' && body !== null ? body : {}) as { detail?: string; hint?: string };
  if (!detail) return `The station answered with ${status}.`;
  return sentences(detail, hint);
}
