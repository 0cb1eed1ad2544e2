import { describe, expect, it } from 'vitest';
import { labelsToShow, type Box, type Wish } from './labels';

const wish = (id: string, left: number, top: number, rank = 4): Wish => ({ id, left, top, width: 60, height: 20, rank });
const icon = (left: number, top: number): Box => ({ left, top, width: 30, height: 30 });
const none = new Set<string>();

describe('labels', () => {
  it('are all shown where there is room', () => {
    expect([...labelsToShow([wish('a', 0, 0), wish('b', 70, 0), wish('c', 500, 900)], new Map(), none)]).toEqual(['a', 'b', 'c']);
  });
  it('give way to who needs attention', () => {
    expect([...labelsToShow([wish('a', 0, 0), wish('b', 10, 5, 0), wish('c', 95, 5)], new Map(), none)]).toEqual(['b', 'c']);
  });
  it('cover no icon but their own', () => {
    const icons = new Map([['a', icon(0, -10)], ['b', icon(200, 0)]]); // prettier-ignore
    expect([...labelsToShow([wish('a', 0, 0), wish('c', 190, 10)], icons, none)]).toEqual(['a']);
  });
  it('stay as they were among equals', () => {
    const crowd = [wish('a', 0, 0), wish('b', 10, 0), wish('c', 20, 0)];
    expect([...labelsToShow(crowd, new Map(), none)]).toEqual(['a']);
    expect([...labelsToShow(crowd, new Map(), new Set(['c']))]).toEqual(['c']);
  });
  it('of a crowd never cover each other', () => {
    const crowd = Array.from({ length: 250 }, (_, index) => wish(String(index), (index * 37) % 900, (index * 53) % 600));
    const shown = labelsToShow(crowd, new Map(), none);
    const boxes = crowd.filter(({ id }) => shown.has(id));
    expect(boxes.length).toBeGreaterThan(30);
    for (const a of boxes)
      for (const b of boxes)
        if (a !== b) expect(Math.abs(a.left - b.left) >= 60 || Math.abs(a.top - b.top) >= 20, `${a.id} and ${b.id}`).toBe(true);
  });
});
