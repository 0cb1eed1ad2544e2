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

/** What kinds of tasks do, in words; others are told by their own. */
const KINDS = new Map([
  ['sequence', 'one after the other'],
  ['concurrent', 'at the same time'],
  ['choice', 'whichever comes first'],
  ['allOf', 'all that come true'],
  ['waitFor', 'wait, then'],
  ['until', 'until'],
  ['during', 'for a time'],
  ['watch', 'whenever'],
  ['action', 'do'],
  ['condition', 'wait until it holds'],
  ['idle', 'wait'],
]);
/** Names that the language prints for tasks that have none. */
const NAMELESS = new Map([
  ['<action>', 'an action'],
  ['<choice>', 'a choice'],
  ['<allOf>', 'all of several'],
  ['<condition>', 'a condition'],
]);

/** A task in words: what it does, and its own name or text if it has one. */
export function wordsOf({ kind, label }: Task): { kind: string; label: string } {
  const words = KINDS.get(kind) ?? kind;
  if (NAMELESS.has(label)) return { kind: words, label: '' };
  const named = label.replace(/watcher<(.*)>/g, 'watching $1').replace(/<\w+>/g, (name) => NAMELESS.get(name) ?? name);
  return { kind: words, label: named };
}
