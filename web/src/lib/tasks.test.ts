import { expect, it } from 'vitest';
import type { Task, TaskState } from './protocol';
import { progressOf, runningLines, wordsOf } from './tasks';

const task = (state: TaskState, line: number, children: Task[] = []): Task => ({
  id: line,
  kind: 'mission',
  label: '',
  line,
  state,
  children,
});

it('finds the lines of the deepest running tasks', () => {
  const tree = task('running', 1, [task('running', 2, [task('done', 3), task('running', 4)]), task('running', 5), task('waiting', 6)]);
  expect([...runningLines([tree])]).toEqual([4, 5]);
});

it('falls back to the parent when a task does not know its line', () => {
  expect([...runningLines([task('running', 7, [task('running', 0)])])]).toEqual([7]);
  expect(runningLines([task('done', 1), task('waiting', 2)]).size).toBe(0);
});

it('counts leaves that have ended', () => {
  const tree = task('running', 1, [task('done', 2), task('failed', 3), task('stopped', 4), task('running', 5), task('waiting', 6)]);
  expect(progressOf([tree])).toEqual({ ended: 3, total: 5 });
  expect(progressOf([])).toEqual({ ended: 0, total: 0 });
});

it('tells tasks in words', () => {
  const task = (kind: string, label: string): Task => ({ id: 1, kind, label, line: 1, state: 'running' });
  expect(wordsOf(task('action', '<action>'))).toEqual({ kind: 'do', label: '' });
  expect(wordsOf(task('choice', '<choice>'))).toEqual({ kind: 'whichever comes first', label: '' });
  expect(wordsOf(task('action', "message 'done'"))).toEqual({ kind: 'do', label: "message 'done'" });
  expect(wordsOf(task('sequence', 'A >> B | <choice>')).label).toBe('A >> B | a choice');
  expect(wordsOf(task('watch', 'watcher<watcher<A>>')).label).toBe('watching watcher<A>');
  expect(wordsOf(task('mission', 'north'))).toEqual({ kind: 'mission', label: 'north' });
});
