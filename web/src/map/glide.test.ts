import { describe, expect, it } from 'vitest';
import { Glide } from './glide';

const A: [number, number] = [8, 47];
const B: [number, number] = [8.001, 47.002];

describe('a glide', () => {
  it('goes evenly from place to place', () => {
    const glide = new Glide();
    glide.moveTo('1', A, 0, true);
    expect(glide.at('1', 0)).toEqual(A);
    expect(glide.goesOn(0)).toBe(false);
    glide.moveTo('1', B, 1000, true);
    expect(glide.at('1', 1110)![1]).toBeCloseTo(47.001, 6);
    expect(glide.goesOn(1110)).toBe(true);
    expect(glide.at('1', 1300)).toEqual(B);
    expect(glide.goesOn(1300)).toBe(false);
  });

  it('goes on from where it is when another place comes meanwhile', () => {
    const glide = new Glide();
    glide.moveTo('1', A, 0, true);
    glide.moveTo('1', B, 1000, true);
    glide.moveTo('1', A, 1110, true);
    expect(glide.at('1', 1110)![1]).toBeCloseTo(47.001, 6);
  });

  it('is none for who does not want motion, nor over a great distance', () => {
    const glide = new Glide();
    glide.moveTo('1', A, 0, true);
    glide.moveTo('1', B, 1000, false);
    expect(glide.at('1', 1000)).toEqual(B);
    glide.moveTo('1', [20, 20], 2000, true);
    expect(glide.at('1', 2000)).toEqual([20, 20]);
  });

  it('is given up for a while where frames take long', () => {
    const glide = new Glide();
    glide.moveTo('1', A, 0, true);
    let now = 1000;
    for (let i = 0; i < 12; ++i) {
      glide.moveTo('1', i % 2 ? A : B, now, true);
      for (let frame = 0; frame < 3; ++frame) glide.goesOn((now += 60));
    }
    glide.moveTo('1', [8.002, 47], now, true);
    expect(glide.at('1', now)).toEqual([8.002, 47]);
    now += 30_000;
    glide.moveTo('1', A, now, true);
    expect(glide.at('1', now)).toEqual([8.002, 47]);
  });
});
