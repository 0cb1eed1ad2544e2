import { describe, expect, it } from 'vitest';
import { Pace } from './pace';

/** A pace whose time goes by when it is told. */
function paced() {
  let time = 1000;
  const waiting: { at: number; work: () => void }[] = [];
  const done: string[] = [];
  const pace = new Pace(
    () => time,
    (work, ms) => waiting.push({ at: time + ms, work }),
  );
  const pass = (ms: number): void => {
    time += ms;
    for (const due of waiting.splice(0)) (due.at <= time ? () => due.work() : () => waiting.push(due))();
  };
  const draw = (ms: number): void => {
    const ends = pace.begins();
    pass(ms);
    ends();
  };
  const run = (name: string, what: string): void => pace.run(name, () => done.push(what));
  return { pass, draw, run, done };
}

describe('what is drawn again and again', () => {
  it('waits for nothing where a picture is quick', () => {
    const { draw, run, done } = paced();
    draw(16);
    for (const piece of ['a', 'b', 'c']) run('slots', piece);
    expect(done).toEqual(['a', 'b', 'c']);
  });

  it('waits for two pictures where one takes long, and then the newest alone is drawn', () => {
    const { pass, draw, run, done } = paced();
    draw(300);
    for (const piece of ['a', 'b', 'c']) run('slots', piece);
    expect(done).toEqual(['a']);
    pass(599);
    expect(done).toEqual(['a']);
    pass(1);
    expect(done).toEqual(['a', 'c']);
    run('slots', 'd');
    expect(done).toEqual(['a', 'c']);
    pass(600);
    run('slots', 'e');
    expect(done).toEqual(['a', 'c', 'd']);
    pass(600);
    expect(done).toEqual(['a', 'c', 'd', 'e']);
  });

  it('does not wait for what is drawn of others, nor for ever', () => {
    const { pass, draw, run, done } = paced();
    draw(5000);
    for (const name of ['slots', 'walls']) run(name, name);
    expect(done).toEqual(['slots', 'walls']);
    run('slots', 'again');
    pass(2000);
    expect(done).toEqual(['slots', 'walls', 'again']);
  });
});
