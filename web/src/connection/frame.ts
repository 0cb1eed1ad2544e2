import type { ServerMessage } from '../lib/protocol';

/** One message of a feed. */
export interface Frame {
  readonly feed: string;
  /** What this page has of the feed once it has taken it. */
  readonly revision: number;
  /** Forget what came before. */
  readonly whole: boolean;
  /** When it is of a type that this app knows. */
  readonly message?: ServerMessage;
  /** Bytes, or an object, without any promise of what is in them. */
  readonly content: Uint8Array | Readonly<Record<string, unknown>>;
}

const HEADER_BYTES = 16;
const FORMAT = 1;
const WHOLE = 1;

const isRevision = (value: unknown): value is number => Number.isSafeInteger(value) && (value as number) >= 0;

/** What the keys of a text say of its feed; nothing for what belongs to none. */
export function textFrame(object: Readonly<Record<string, unknown>>, message: ServerMessage | undefined): Frame | undefined {
  const { feed, revision, whole } = object;
  if (typeof feed !== 'string' || !isRevision(revision)) return undefined;
  return { feed, revision, whole: whole === true, ...(message && { message }), content: object };
}

/** What the header of bytes says; nothing when it cannot be read, or for a feed that the station has not named. */
export function binaryFrame(data: ArrayBuffer, feeds: ReadonlyMap<number, string>): Frame | undefined {
  if (data.byteLength < HEADER_BYTES) return undefined;
  const header = new DataView(data, 0, HEADER_BYTES);
  const feed = feeds.get(header.getUint16(2, true));
  const revision = Number(header.getBigUint64(8, true));
  if (header.getUint8(0) !== FORMAT || feed === undefined || !isRevision(revision)) return undefined;
  const whole = (header.getUint8(1) & WHOLE) !== 0;
  return { feed, revision, whole, content: new Uint8Array(data, HEADER_BYTES) };
}
