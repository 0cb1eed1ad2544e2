import { describe, expect, it } from 'vitest';
import { filtered, outcomeText, parseValue, problemText, progressText, type Parameter } from './parameters';

const all: Parameter[] = ['WPNAV_SPEED', 'RTL_ALT', 'WPNAV_RADIUS', 'RTL_SPEED'].map((name) => ({ name, value: 1, type: 'real32' }));
const names = (words: string): string[] => filtered(all, words).map(({ name }) => name);

describe('filtered', () => {
  it('gives all in the order of the alphabet without words', () => {
    expect(names('  ')).toEqual(['RTL_ALT', 'RTL_SPEED', 'WPNAV_RADIUS', 'WPNAV_SPEED']);
  });
  it('finds parts of names in any case, and all of several words', () => {
    expect(names('speed')).toEqual(['RTL_SPEED', 'WPNAV_SPEED']);
    expect(names('speed wp')).toEqual(['WPNAV_SPEED']);
  });
  it('takes * for anything and everything else as it stands', () => {
    expect(names('wp*rad')).toEqual(['WPNAV_RADIUS']);
    expect(names('.')).toEqual([]);
    expect(names('[')).toEqual([]);
  });
  it('puts numbers in names in their order', () => {
    const servos = ['SERVO10_MIN', 'SERVO2_MIN'].map((name) => ({ name, value: 1, type: 'int16' }));
    expect(filtered(servos, '').map(({ name }) => name)).toEqual(['SERVO2_MIN', 'SERVO10_MIN']);
  });
  it('leaves the list that it is given alone', () => {
    filtered(all, '');
    expect(all[0]?.name).toBe('WPNAV_SPEED');
  });
});

describe('parseValue', () => {
  it('reads numbers, with a comma too', () => {
    expect(parseValue(' 801.5 ', 'real32')).toEqual({ value: 801.5 });
    expect(parseValue('0,5', 'real32')).toEqual({ value: 0.5 });
    expect(parseValue('1e3', 'int16')).toEqual({ value: 1000 });
    expect(parseValue('-128', 'int8')).toEqual({ value: -128 });
  });
  it('refuses what is no number', () => {
    for (const text of ['', ' ', 'NaN', 'Infinity', '1,000,5', 'seven', '1e999'])
      expect(parseValue(text, 'real32'), text).toHaveProperty('problem');
  });
  it('refuses what the type cannot hold', () => {
    expect(parseValue('0.5', 'int32')).toEqual({ problem: 'This parameter is an integer.' });
    expect(parseValue('256', 'uint8')).toEqual({ problem: 'This parameter holds 0 to 255.' });
    expect(parseValue('1e39', 'real32')).toEqual({ problem: 'This is too large.' });
  });
});

describe('texts', () => {
  it('say what the vehicle holds after a change', () => {
    expect(outcomeText({ name: 'RTL_ALT', value: 2000, type: 'int32', before: 1500 })).toBe('RTL_ALT is 2000 now, was 1500.');
    expect(outcomeText({ name: 'RTL_ALT', value: 2000, type: 'int32', before: 2000 })).toBe('RTL_ALT is 2000, as it was.');
  });
  it('say how far a list has come, once its length is known', () => {
    expect(progressText({ fetching: true, done: 3, total: 9 })).toBe('3 of 9');
    expect(progressText({ fetching: true, done: 0, total: 0 })).toBe('');
  });
  it('say why a request was refused', () => {
    expect(problemText(409, { detail: 'copter 1 is commanded by anna', hint: 'ask for it' })).toBe(
      'copter 1 is commanded by anna. Ask for it.',
    );
    expect(problemText(undefined, undefined)).toBe('The station did not answer.');
    expect(problemText(500, 'text')).toBe('The station answered with 500.');
  });
});
