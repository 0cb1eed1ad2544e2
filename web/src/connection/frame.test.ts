import { expect, it } from 'vitest';
import { binaryFrame, textFrame } from './frame';
import type { ServerMessage } from '../lib/protocol';

const FEEDS = new Map([[0x0203, 'map']]);
const bytes = (...values: number[]): ArrayBuffer => new Uint8Array(values).buffer;

it('reads the header of bytes', () => {
  const data = bytes(1, 1, 3, 2, 0, 0, 0, 0, 6, 5, 4, 3, 2, 1, 0, 0, 0x78, 0x79);
  expect(binaryFrame(data, FEEDS)).toEqual({ feed: 'map', revision: 0x010203040506, whole: true, content: new Uint8Array([0x78, 0x79]) });
  const next = bytes(1, 0, 3, 2, 0, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0);
  expect(binaryFrame(next, FEEDS)).toEqual({ feed: 'map', revision: 7, whole: false, content: new Uint8Array() });
});

it('skips bytes that it cannot read', () => {
  const header = [1, 0, 3, 2, 0, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0];
  const but = (at: number, value: number) => bytes(...header.map((byte, index) => (index === at ? value : byte)));
  for (const data of [bytes(), bytes(...header.slice(1)), but(0, 2), but(2, 4), but(15, 255)])
    expect(binaryFrame(data, FEEDS)).toBeUndefined();
});

it('finds the feed of a text', () => {
  const object = { type: 'weather', wind: 3, feed: 'weather', revision: 4, whole: true };
  expect(textFrame(object, undefined)).toEqual({ feed: 'weather', revision: 4, whole: true, content: object });
  const message: ServerMessage = { type: 'tasks', trees: [] };
  expect(textFrame({ ...message, feed: 'tasks', revision: 1 }, message)).toMatchObject({ whole: false, message });
  for (const keys of [{}, { feed: 'tasks' }, { feed: 3, revision: 1 }, { feed: 'tasks', revision: -1 }, { feed: 'tasks', revision: 1.5 }])
    expect(textFrame({ ...message, ...keys }, message)).toBeUndefined();
});
