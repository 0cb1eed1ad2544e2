import { describe, expect, it } from 'vitest';
import { appendLines, foldCommands, LOG_LIMIT, soughtIn, type LogFilter } from './log';
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

const say = (text: string, level: LogLevel = 'info', source = 'control'): LogLine => ({ seq: 1, level, time: '', source, text });
const texts = (lines: LogLine[], filter: Partial<LogFilter> = {}): string[] =>
  soughtIn(foldCommands(lines), { lowest: 'debug', words: '', vehicles: undefined, ...filter }).map(({ text }) => text);

describe('a command', () => {
  const takeOff = [
    say('operator 1 commands take_off to 3 vehicles'),
    say('take_off of vehicle 2: confirmed'),
    say('take_off of vehicle 3: refused: Throttle too high', 'warn'),
    say('battery at 27 %', 'warn', 'vehicle 2'),
    say('take_off of vehicle north/1: confirmed'),
  ];

  it('is one line with what became of it, however many vehicles', () => {
    expect(texts(takeOff)).toEqual(['operator 1 commands take_off to 3 vehicles: 2 confirmed, 1 refused', 'battery at 27 %']);
    const [entry] = foldCommands(takeOff);
    expect(entry).toMatchObject({ level: 'warn' });
    expect(entry!.more).toHaveLength(3);
  });

  it('takes no outcome of another, nor one too many', () => {
    const lines = [
      say('operator 1 commands land to 1 vehicle'),
      say('operator 2 commands land to 1 vehicle'),
      say('land of vehicle 1: landed'),
      say('land of vehicle 1: cut short: by operator 2', 'warn'),
      say('land of vehicle 1: confirmed after all'),
    ];
    expect(texts(lines)).toEqual([
      'operator 1 commands land to 1 vehicle: cut short',
      'operator 2 commands land to 1 vehicle: landed',
      'land of vehicle 1: confirmed after all',
    ]);
  });

  it('is found by level, words and vehicle', () => {
    expect(texts(takeOff, { lowest: 'error' })).toEqual([]);
    expect(texts(takeOff, { words: 'throttle' })).toHaveLength(1);
    expect(texts(takeOff, { vehicles: [{ id: 'north/1', name: 'copter 1' }] })).toHaveLength(1);
    expect(texts(takeOff, { vehicles: [{ id: '2', name: 'copter 2' }] })).toHaveLength(2);
    expect(texts(takeOff, { vehicles: [{ id: '1', name: 'copter 1' }] })).toEqual([]);
  });
});
