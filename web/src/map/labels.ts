/** A label that wants its place, in px of the screen. */
export interface Wish {
  id: string;
  left: number;
  top: number;
  width: number;
  height: number;
  /** The lowest come first. */
  rank: number;
}

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

const CELL_PX = 96;

/**
 * Which labels can be shown without covering another one, or an icon that is not their own. Of equals, who was shown before is shown
 * again, so that labels do not come and go while vehicles pass each other.
 */
export function labelsToShow(wishes: readonly Wish[], icons: ReadonlyMap<string, Box>, before: ReadonlySet<string>): Set<string> {
  const taken = new Map<string, (Box & { of: string })[]>();
  const cellsOf = ({ left, top, width, height }: Box): string[] => {
    const cells: string[] = [];
    for (let x = Math.floor(left / CELL_PX); x <= Math.floor((left + width) / CELL_PX); ++x)
      for (let y = Math.floor(top / CELL_PX); y <= Math.floor((top + height) / CELL_PX); ++y) cells.push(`${x} ${y}`);
    return cells;
  };
  const take = (of: string, box: Box): void => {
    for (const cell of cellsOf(box)) {
      const there = taken.get(cell);
      if (there) there.push({ ...box, of });
      else taken.set(cell, [{ ...box, of }]);
    }
  };
  for (const [id, box] of icons) take(id, box);
  const order = [...wishes].sort((a, b) => a.rank - b.rank || Number(before.has(b.id)) - Number(before.has(a.id)));
  const shown = new Set<string>();
  for (const wish of order) {
    const isFree = cellsOf(wish).every((cell) => (taken.get(cell) ?? []).every((other) => other.of === wish.id || !overlap(wish, other)));
    if (!isFree) continue;
    take(wish.id, wish);
    shown.add(wish.id);
  }
  return shown;
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height && b.top < a.top + a.height;
}
