/** Gives back the list that it was given before, as long as the next one has the same in it: what depends on it need not be done again. */
export function keepsSame<T>(): (next: readonly T[]) => readonly T[] {
  let last: readonly T[] = [];
  return (next) => {
    const isSame = next.length === last.length && next.every((one, index) => one === last[index]);
    if (!isSame) last = next;
    return last;
  };
}
