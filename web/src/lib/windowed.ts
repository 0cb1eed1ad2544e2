/** The part of a long list that is in sight, and what stands for the rest above and below it, in px. */
export interface Windowed {
  first: number;
  /** Behind the last one. */
  end: number;
  before: number;
  after: number;
}

/** Some more than is in sight, so that a quick scroll does not show a gap. */
const SPARE = 4;

/** Of items of these sizes in px, one behind the other, those that lie between `from` and `from + extent`. */
export function windowOf(sizes: readonly number[], from: number, extent: number): Windowed {
  let first = 0;
  let before = 0;
  while (first < sizes.length && before + sizes[first]! <= from) before += sizes[first++]!;
  let end = first;
  let reached = before;
  while (end < sizes.length && reached < from + extent) reached += sizes[end++]!;
  for (let i = 0; i < SPARE && first > 0; ++i) before -= sizes[--first]!;
  for (let i = 0; i < SPARE && end < sizes.length; ++i) reached += sizes[end++]!;
  const whole = sizes.reduce((sum, size) => sum + size, 0);
  return { first, end, before, after: whole - reached };
}

/** Where a list must scroll to, so that the item is wholly in sight; where it is if it is so already. */
export function scrollTo(sizes: readonly number[], index: number, from: number, extent: number): number {
  const start = sizes.slice(0, index).reduce((sum, size) => sum + size, 0);
  const end = start + (sizes[index] ?? 0);
  if (start < from) return start;
  return end > from + extent ? end - extent : from;
}
