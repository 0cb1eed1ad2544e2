import type { LinkQuality } from './protocol';

/** Numbers for people. What is not known is an en dash, never 0. */
const UNKNOWN = '–';

/** What went wrong and what to do, which the station says without the marks of sentences. The first word may be a name. */
export function sentences(...parts: unknown[]): string {
  return parts
    .filter((part): part is string => typeof part === 'string' && part !== '')
    .map((part) => (/[.!?]$/.test(part) ? part : `${part}.`))
    .map((part, index) => (index === 0 ? part : part[0]!.toUpperCase() + part.slice(1)))
    .join(' ');
}

export function metres(value: number | undefined | null): string {
  if (value === undefined || value === null) return UNKNOWN;
  return `${clean(value.toFixed(Math.abs(value) < 9.95 ? 1 : 0))} m`;
}

export function speed(value: number | undefined | null): string {
  return value === undefined || value === null ? UNKNOWN : `${clean(value.toFixed(1))} m/s`;
}

export function percent(share: number | undefined | null): string {
  return share === undefined || share === null ? UNKNOWN : `${Math.round(share * 100)} %`;
}

/** "0.4 s", "12 s", "3 min", "2 h". */
export function age(seconds: number | undefined): string {
  if (seconds === undefined) return UNKNOWN;
  if (seconds < 9.95) return `${seconds.toFixed(1)} s`;
  if (seconds < 120) return `${Math.round(seconds)} s`;
  if (seconds < 7200) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h`;
}

/** The link that is used, in short: "2 % lost"; with several links how many are alive. */
export function linkSummary(links: LinkQuality[] | undefined): string {
  const used = links?.find((link) => link.used);
  if (!links || !used) return '';
  const alive = links.filter((link) => link.alive).length;
  return `${lossText(used)}${links.length > 1 ? `, ${alive} of ${links.length} links` : ''}`;
}

/** What was lost of nothing is not known: it is not "0 %". */
function lossText({ loss }: LinkQuality): string {
  return loss === undefined ? 'loss unknown' : `${percent(loss)} lost`;
}

/** One link, without its name: "2 % lost, 120 ms, 20 messages/s". */
export function linkText(link: LinkQuality): string {
  if (!link.alive) return 'silent';
  const round_trip = link.round_trip_s === undefined ? '' : `${Math.round(link.round_trip_s * 1000)} ms, `;
  return `${lossText(link)}, ${round_trip}${link.messages_per_s} messages/s`;
}

/** Every link on a line of its own. */
export function linkTitle(links: LinkQuality[] | undefined): string | undefined {
  return links?.map((link) => `${link.name}: ${linkText(link)}${link.used ? ' (commands go here)' : ''}`).join('\n');
}

/** How long something lasts: "40 s", "12 min", "1 h 5 min". */
export function span(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** A time that may be off by so much to either side: "about 17 min", or "15–20 min" where that is more than a tenth. */
export function spanAbout(seconds: number, error: number): string {
  if (error <= seconds * 0.1) return `about ${span(seconds)}`;
  const [least, most] = [Math.max(0, seconds - error), seconds + error];
  if (most < 90) return `${Math.round(least)}–${Math.round(most)} s`;
  const [shortest, longest] = [Math.floor(least / 60), Math.ceil(most / 60)];
  if (longest < 60) return `${shortest}–${longest} min`;
  return `${span(Math.max(60, least))} – ${span(most)}`;
}

export function heading(radians: number | undefined): string {
  if (radians === undefined) return UNKNOWN;
  const degrees = ((Math.round((radians * 180) / Math.PI) % 360) + 360) % 360;
  return `${String(degrees).padStart(3, '0')}°`;
}

/** "35.36326° S". */
export function latitude(degrees: number): string {
  return `${Math.abs(degrees).toFixed(5)}° ${degrees < 0 ? 'S' : 'N'}`;
}

export function longitude(degrees: number): string {
  return `${Math.abs(degrees).toFixed(5)}° ${degrees < 0 ? 'W' : 'E'}`;
}

/** The time of day in the browser's own zone, from ISO 8601. */
export function clock(iso: string): string {
  const time = new Date(iso);
  return Number.isNaN(time.getTime()) ? UNKNOWN : time.toLocaleTimeString('en-GB');
}

/** The last part of a path. */
export function fileName(path: string): string {
  return path.split('/').at(-1) || path;
}

function clean(text: string): string {
  return text.replace(/^-(0(\.0*)?)$/, '$1').replace('-', '−');
}
