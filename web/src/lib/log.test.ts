import { expect, it } from 'vitest';
import { appendLines, atLeast, LOG_LIMIT } from './log';
import type { LogLevel, LogLine } from './protocol';

const line = (seq: number, level: LogLevel = 'info'): LogLine => ({ seq, level, time: '', source: '', text: '' });

it('leaves out lines that are here already', () => {
  const lines = [line(1), line(2)];
  expect(appendLines(lines, [line(1), line(2), line(3)], 2).map((l) => l.seq)).toEqual([1, 2, 3]);
  expect(appendLines(lines, [line(1), line(2)], 2)).toBe(lines);
});

it('keeps a bounded number', () => {
  const many = Array.from({ length: LOG_LIMIT + 10 }, (_, i) => line(i + 1));
  const kept = appendLines([], many, 0);
  expect(kept).toHaveLength(LOG_LIMIT);
  expect(kept[0]?.seq).toBe(11);
});

it('filters by severity', () => {
  const lines = [line(1, 'debug'), line(2), line(3, 'warn'), line(4, 'error')];
  expect(atLeast(lines, 'warn').map((l) => l.seq)).toEqual([3, 4]);
  expect(atLeast(lines, 'debug')).toHaveLength(4);
});
