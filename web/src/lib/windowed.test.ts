import { expect, it } from 'vitest';
import { scrollTo, windowOf } from './windowed';

const sizes = Array.from({ length: 250 }, () => 50);

it('has what is in sight and little more, however long the list', () => {
  const { first, end, before, after } = windowOf(sizes, 5000, 600);
  expect([first, end]).toEqual([96, 116]);
  expect(before).toBe(96 * 50);
  expect(after).toBe((250 - 116) * 50);
});

it('ends where the list does', () => {
  expect(windowOf(sizes, 0, 600)).toEqual({ first: 0, end: 16, before: 0, after: 234 * 50 });
  expect(windowOf(sizes, 250 * 50 - 600, 600)).toMatchObject({ end: 250, after: 0 });
  expect(windowOf([], 0, 600)).toEqual({ first: 0, end: 0, before: 0, after: 0 });
  expect(windowOf(sizes.slice(0, 3), 9000, 600)).toMatchObject({ first: 0, end: 3, before: 0 });
});

it('scrolls as far as an item wants, and not at all to one in sight', () => {
  expect(scrollTo(sizes, 2, 500, 600)).toBe(100);
  expect(scrollTo(sizes, 100, 0, 600)).toBe(101 * 50 - 600);
  expect(scrollTo(sizes, 12, 500, 600)).toBe(500);
});
