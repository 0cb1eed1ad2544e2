import { describe, expect, it } from 'vitest';
import {
  age,
  clock,
  heading,
  latitude,
  linkSummary,
  linkTitle,
  longitude,
  metres,
  percent,
  sentences,
  span,
  spanAbout,
  speed,
} from './format';

describe('format', () => {
  it('shows what is unknown as a dash, never as 0', () => {
    for (const show of [metres, speed, percent, age, heading]) expect(show(undefined)).toBe('–');
    expect(metres(null)).toBe('–');
  });
  it('makes sentences of what went wrong and what to do', () => {
    expect(sentences('nothing comes from 127.0.0.1:3080', 'is [stream] in its file?')).toBe(
      'nothing comes from 127.0.0.1:3080. Is [stream] in its file?',
    );
    expect(sentences('It is away.', undefined, '')).toBe('It is away.');
    expect(sentences(undefined)).toBe('');
  });
  it('shows metres with one decimal below ten', () => {
    expect([metres(0.04), metres(-0.04), metres(9.94), metres(9.96), metres(-12.4)]).toEqual(['0.0 m', '0.0 m', '9.9 m', '10 m', '−12 m']);
  });
  it('shows speeds and shares', () => {
    expect(speed(8.04)).toBe('8.0 m/s');
    expect(percent(0.274)).toBe('27 %');
  });
  it('shows ages in the unit that fits', () => {
    expect([age(0.42), age(12.3), age(119), age(300), age(7300)]).toEqual(['0.4 s', '12 s', '119 s', '5 min', '2 h']);
  });
  it('shows the link that is used, and how many live', () => {
    const wifi = { name: 'wifi', loss: 0.024, messages_per_s: 20, bytes_per_s: 900, round_trip_s: 0.12, alive: true, used: true };
    const radio = { name: 'radio', loss: 0, messages_per_s: 0, bytes_per_s: 0, alive: false, used: false };
    expect(linkSummary([wifi])).toBe('2 % lost');
    expect(linkSummary([radio, wifi])).toBe('2 % lost, 1 of 2 links');
    expect(linkSummary([radio])).toBe('');
    expect(linkSummary(undefined)).toBe('');
    expect(linkTitle([wifi, radio])).toBe('wifi: 2 % lost, 120 ms, 20 messages/s (commands go here)\nradio: silent');
  });
  it('does not tell what was lost of nothing', () => {
    const { loss, ...silent } = { name: 'wifi', loss: 0, messages_per_s: 0, bytes_per_s: 0, alive: true, used: true };
    expect(linkSummary([silent])).toBe('loss unknown');
    expect(linkTitle([silent])).toMatch(/^wifi: loss unknown/);
    expect(linkSummary([{ ...silent, loss }])).toBe('0 % lost');
  });
  it('shows a time that is not sure as a range that is no finer than it is', () => {
    expect([spanAbout(1020, 60), spanAbout(1050, 150), spanAbout(3300, 900)]).toEqual(['about 17 min', '15–20 min', '40 min – 1 h 10 min']);
    expect([spanAbout(40, 20), spanAbout(0, 6), spanAbout(70, 40)]).toEqual(['20–60 s', '0–6 s', '0–2 min']);
  });
  it('shows headings with three digits', () => {
    expect([heading(0), heading(Math.PI / 2), heading(-0.1), heading(6.28318)]).toEqual(['000°', '090°', '354°', '000°']);
  });
  it('shows places with their hemisphere', () => {
    expect(latitude(-35.363262)).toBe('35.36326° S');
    expect(longitude(149.165237)).toBe('149.16524° E');
  });
  it('shows a time of day, and a dash for none', () => {
    expect(clock('2026-01-01T12:34:56.789Z')).toMatch(/^\d\d:34:56$/);
    expect(clock('rubbish')).toBe('–');
  });
});

it.each([
  [40, '40 s'],
  [720, '12 min'],
  [3900, '1 h 5 min'],
])('%d s last %s', (seconds, text) => {
  expect(span(seconds)).toBe(text);
});
