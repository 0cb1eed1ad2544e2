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

/** A line as it is shown: one of the station's, or one about many vehicles that stands for several. */
export interface LogEntry {
  first: LogLine;
  level: LogLevel;
  text: string;
  /** What it stands for besides its first line. */
  more: LogLine[];
}

/** A command and what became of it are told this near to each other, however long it takes. */
const COMMAND = /^(.+) commands (\w+) to (\d+) vehicles?$/;
const OUTCOME = /^(\w+) of vehicle (\S+): ([\w ]+?)(?:: .*)?$/;

interface Open {
  entry: LogEntry;
  head: string;
  action: string;
  /** Vehicles whose outcome has not been told. */
  missing: number;
  told: Map<string, string>;
}

/** One entry a command, with what became of it: what each vehicle made of it is below. Everything else stays as it is. */
export function foldCommands(lines: readonly LogLine[]): LogEntry[] {
  const entries: LogEntry[] = [];
  const open: Open[] = [];
  for (const line of lines) {
    const outcome = OUTCOME.exec(line.text);
    const of = outcome && open.findLast(({ action, missing, told }) => action === outcome[1] && missing > 0 && !told.has(outcome[2]!));
    if (of) {
      add(of, line, outcome[2]!, outcome[3]!);
      continue;
    }
    const entry: LogEntry = { first: line, level: line.level, text: line.text, more: [] };
    entries.push(entry);
    const command = COMMAND.exec(line.text);
    if (command) open.push({ entry, head: line.text, action: command[2]!, missing: Number(command[3]), told: new Map() });
  }
  return entries;
}

function add(of: Open, line: LogLine, vehicle: string, state: string): void {
  of.entry.more.push(line);
  of.missing -= 1;
  of.told.set(vehicle, state);
  if (ORDER[line.level] > ORDER[of.entry.level]) of.entry.level = line.level;
  const counts = new Map<string, number>();
  for (const told of of.told.values()) counts.set(told, (counts.get(told) ?? 0) + 1);
  of.entry.text = `${of.head}: ${[...counts].map(([told, count]) => (of.told.size === 1 && of.missing === 0 ? told : `${count} ${told}`)).join(', ')}`;
}

export interface LogFilter {
  lowest: LogLevel;
  words: string;
  /** Ids and names of the vehicles that it is to be about; nothing: of anything. */
  vehicles: readonly { id: string; name: string }[] | undefined;
}

/** The entries that are looked for. Whoever looks for a vehicle finds each command that it was given, too. */
export function soughtIn(entries: readonly LogEntry[], { lowest, words, vehicles }: LogFilter): LogEntry[] {
  const sought = words.toLowerCase().split(/\s+/).filter(Boolean);
  const about =
    vehicles &&
    new RegExp(`(^|[^\\w/])(${vehicles.flatMap(({ id, name }) => [`vehicle ${escape(id)}`, escape(name)]).join('|')})(?![\\w/])`);
  return entries.filter(({ first, level, text, more }) => {
    if (ORDER[level] < ORDER[lowest]) return false;
    const told = [`${first.source}: ${text}`, ...more.map((line) => line.text)];
    if (about && !told.some((one) => about.test(one))) return false;
    return sought.every((word) => told.some((one) => one.toLowerCase().includes(word)));
  });
}

function escape(text: string): string {
  return text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
}
