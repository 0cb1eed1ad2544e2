import { expect, it } from 'vitest';
import { rtpAge } from './live_video';

const TURN = 2 ** 32;
const rtp = (time_ms: number): number => (time_ms * 90) % TURN;
const now = 1_795_643_376_110;

it('tells the age of a picture from the lower bits of its time', () => {
  expect(rtpAge(rtp(now - 42), now)).toBeCloseTo(42, 1);
  expect(rtpAge(rtp(now), now)).toBeCloseTo(0, 1);
});

it('tells a clock that is ahead as one, and minutes as minutes', () => {
  expect(rtpAge(rtp(now + 300), now)).toBeCloseTo(-300, 1);
  expect(rtpAge(rtp(now - 3_600_000), now)).toBeCloseTo(3_600_000, 1);
});

it('is the same where the counter begins anew between the picture and now', () => {
  const begins = Math.ceil(now / (TURN / 90)) * (TURN / 90);
  expect(rtpAge(rtp(begins - 20), begins + 30)).toBeCloseTo(50, 1);
});
