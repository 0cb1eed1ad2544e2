import type { Task } from './protocol';

/** The script lines on which something runs now: those of the deepest running tasks. */
export function runningLines(trees: Task[]): Set<number> {
  const lines = new Set<number>();
  for (const task of trees) {
    if (task.state !== 'running') continue;
    const deeper = runningLines(task.children ?? []);
    if (deeper.size > 0) deeper.forEach((line) => lines.add(line));
    else if (task.line > 0) lines.add(task.line);
  }
  return lines;
}

/** How many leaves of the trees have ended, of how many. */
export function progressOf(trees: Task[]): { ended: number; total: number } {
  let ended = 0;
  let total = 0;
  for (const task of trees) {
    const below = task.children?.length ? progressOf(task.children) : undefined;
    ended += below ? below.ended : task.state === 'done' || task.state === 'failed' || task.state === 'stopped' ? 1 : 0;
    total += below ? below.total : 1;
  }
  return { ended, total };
}
