import { describe, expect, it, vi } from 'vitest';
import { Pace, whenDrawn } from './pace';

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
  const run = (name: string, what: string, isMuch = false): void => pace.run(name, () => done.push(what), isMuch);
  return { pass, draw, run, done, end: () => pace.end() };
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
    run('slots', 'a');
    pass(10);
    for (const piece of ['b', 'c', 'd']) run('slots', piece);
    pass(599);
    expect(done).toEqual(['a']);
    pass(1);
    expect(done).toEqual(['a', 'd']);
    pass(5000);
    run('slots', 'e');
    pass(10);
    expect(done).toEqual(['a', 'd', 'e']);
  });

  it('has the differences of all sources drawn together where a picture takes long', () => {
    const { pass, draw, run, done } = paced();
    draw(300);
    for (const name of ['slots', 'walls']) run(name, name);
    expect(done).toEqual([]);
    pass(10);
    expect(done).toEqual(['slots', 'walls']);
    run('slots', 'slots again');
    pass(400);
    run('walls', 'walls again');
    pass(200);
    expect(done).toEqual(['slots', 'walls', 'slots again', 'walls again']);
  });

  it('does not wait for ever', () => {
    const { pass, draw, run, done } = paced();
    draw(5000);
    run('slots', 'a');
    pass(10);
    run('slots', 'b');
    pass(2000);
    expect(done).toEqual(['a', 'b']);
  });

  it('waits for the last piece of much that comes in pieces, also on a quick machine, and everything is drawn once', () => {
    const { pass, run, done } = paced();
    for (const piece of ['a', 'b', 'c']) {
      run('slots', piece, true);
      pass(60);
    }
    run('walls', 'w');
    pass(59);
    expect(done).toEqual([]);
    pass(1);
    expect(done).toEqual(['c', 'w']);
  });

  it('draws what there is of pieces that do not end', () => {
    const { pass, run, done } = paced();
    for (let piece = 0; piece < 31; ++piece) {
      run('slots', `${piece}`, true);
      pass(50);
    }
    expect(done.length).toBe(1);
  });

  it('does nothing any more for a map that is gone', () => {
    const { pass, run, done, end } = paced();
    run('slots', 'a', true);
    end();
    pass(5000);
    expect(done).toEqual([]);
  });
});

describe('when a picture is drawn', () => {
  /** A context that has drawn, or not yet, and frames that come when they are told. */
  function drawing() {
    const context = {
      SIGNALED: 1,
      isDrawn: false,
      isLost: false,
      fenceSync: (): object | null => ({}),
      flush: vi.fn(),
      deleteSync: vi.fn(),
      getSyncParameter: (): number => (context.isDrawn ? 1 : 0),
      isContextLost: (): boolean => context.isLost,
    };
    const frames: (() => void)[] = [];
    const drawn = vi.fn();
    const begin = (): void => whenDrawn(context as unknown as WebGL2RenderingContext, drawn, (look) => frames.push(look));
    const frame = (): void => frames.splice(0).forEach((look) => look());
    return { context, frames, drawn, begin, frame };
  }

  it('is told in the first frame after that, however many come before', () => {
    const { context, drawn, begin, frame, frames } = drawing();
    begin();
    frame();
    frame();
    expect(drawn).not.toHaveBeenCalled();
    context.isDrawn = true;
    frame();
    expect(drawn).toHaveBeenCalledOnce();
    expect(frames).toEqual([]);
    expect(context.deleteSync).toHaveBeenCalledOnce();
  });

  it('is not waited for where the context is lost, or has no fences', () => {
    const { context, drawn, begin, frame } = drawing();
    begin();
    context.isLost = true;
    frame();
    expect(drawn).toHaveBeenCalledTimes(1);
    context.fenceSync = () => null;
    begin();
    expect(drawn).toHaveBeenCalledTimes(2);
  });
});
