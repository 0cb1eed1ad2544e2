import type { LogLevel, LogLine } from './protocol';

export const LOG_LIMIT = 1000;
const ORDER: Record<LogLevel, number> = { debug: 0, info: 1, warn: 2, error: 3 };

/**
 * The lines with the new ones at the end, without those that are here already (the station repeats its history when it sends
 * the whole state), bounded. A station that counts from 1 again has been started anew: its lines follow the old ones.
 */
export function appendLines(lines: LogLine[], news: LogLine[], lastSeq: number): LogLine[] {
  const fresh = news.filter((line) => line.seq > lastSeq);
  return fresh.length === 0 ? lines : [...lines, ...fresh].slice(-LOG_LIMIT);
}

export function atLeast(lines: LogLine[], lowest: LogLevel): LogLine[] {
  return lines.filter((line) => ORDER[line.level] >= ORDER[lowest]);
}
