import { flushSync } from 'svelte';
import { afterEach, describe, expect, it } from 'vitest';
import { createStores } from '../stores/stores';
import { Archive } from './archive';
import { Player } from './player.svelte';

/** A station that has shown one vehicle, whose mode is the second of the session. */
class KeptStation {
  readonly asked: string[] = [];
  ended_ms = 1_060_000;
  isAway = false;

  readonly ask = (address: string): Promise<Response | undefined> => {
    this.asked.push(address);
    if (this.isAway) return Promise.resolve(undefined);
    const { pathname, searchParams } = new URL(address, 'http://station');
    const time = (name: string): number => Number(searchParams.get(name));
    if (pathname === '/api/v1/history') {
      const sessions = [
        { id: 'new', name: 'now', began_ms: 1_000_000, ended_ms: this.ended_ms },
        { id: 'old', name: 'then', began_ms: 500_000, ended_ms: 510_000 },
        { id: 'broken' },
      ];
      return Promise.resolve(Response.json({ sessions }));
    }
    if (pathname.endsWith('/state'))
      return Promise.resolve(Response.json({ frames: [frame(Math.floor(time('at_ms') / 1000) * 1000, true)] }));
    const frames = [];
    for (let at = Math.ceil(time('from_ms') / 1000) * 1000; at < time('to_ms'); at += 1000) frames.push(frame(at, false));
    return Promise.resolve(Response.json({ frames, complete_to_ms: time('to_ms') }));
  };
}

function frame(at_ms: number, full: boolean) {
  const vehicles = [{ id: '1', name: 'one', mode: `second ${(at_ms - 1_000_000) / 1000}`, position: { lat_deg: 1, lon_deg: 2, alt_m: 3 } }];
  return {
    at_ms,
    feed: 'vehicles',
    whole: full,
    message: { type: 'vehicles', feed: 'vehicles', revision: at_ms, whole: full, time_s: at_ms / 1000, full, vehicles },
  };
}

const YARD = { name: 'yard', origin: { lat_deg: 47.4, lon_deg: 8.5, alt_m: 420 } };
const quiet = { beep: () => {}, speak: () => {}, wake: () => {}, isMuted: true };
let end = (): void => {};
afterEach(() => end());

function playing() {
  const station = new KeptStation();
  const player = new Player(new Archive(station.ask), YARD);
  const stores = createStores(
    { open: () => player.socket, fetch: () => Promise.reject(new Error('asked')), token: undefined, keepToken: () => {} },
    quiet,
  );
  end = () => stores.session.end();
  const mode = (): string | undefined => (flushSync(), stores.fleet.get('1')?.fields.mode);
  return { station, player, stores, mode };
}

/** Lets what was asked for come. */
const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

describe('looking back', () => {
  it('begins a minute before the end of the newest session, standing still', async () => {
    const { player, mode, stores } = playing();
    await player.open();
    expect(player.session?.id).toBe('new');
    expect(player.at_ms).toBe(1_000_000);
    expect(mode()).toBe('second 0');
    player.advance(3000);
    expect(mode()).toBe('second 0');
    expect(stores.session.operator).toBe('');
  });

  it('plays a session that is wanted from its beginning', async () => {
    const { player } = playing();
    await player.play('old');
    expect([player.session?.id, player.at_ms, player.isPlaying]).toEqual(['old', 500_000, true]);
  });

  it('asks for pictures of what is shown as of then', async () => {
    const { player } = playing();
    const past = (): { session: string; at_ms: number } => ({ session: player.session!.id, at_ms: player.at_ms });
    const network = { open: () => player.socket, fetch: () => Promise.reject(new Error('asked')), token: undefined, keepToken: () => {} };
    await player.open(1_010_000);
    const looksBack = createStores({ ...network, past }, quiet);
    const isLive = createStores(network, quiet);
    expect(looksBack.session.addressThen('/p?revision=2')).toBe('/p?revision=2&session=new&at_ms=1010000');
    expect(isLive.session.addressThen('/p?revision=2')).toBe('/p?revision=2');
    for (const { session } of [looksBack, isLive]) session.end();
  });

  it('leaves out what is no session', async () => {
    const { player } = playing();
    await player.open();
    expect(player.sessions.map(({ id }) => id)).toEqual(['new', 'old']);
  });

  it('plays what was shown, at the speed that is chosen', async () => {
    const { player, mode } = playing();
    await player.open(1_010_000);
    player.togglePlaying();
    player.advance(0);
    await settled();
    player.advance(2000);
    expect(mode()).toBe('second 12');
    player.speed = 5;
    player.advance(1000);
    expect(mode()).toBe('second 17');
  });

  it('waits for what it does not know yet, and leaves nothing out', async () => {
    const { player, mode } = playing();
    await player.open(1_010_000);
    player.togglePlaying();
    player.advance(30_000);
    expect(mode()).toBe('second 10');
    await settled();
    player.advance(5000);
    expect(mode()).toBe('second 15');
  });

  it('goes back and forth', async () => {
    const { player, mode } = playing();
    await player.open(1_030_000);
    await player.step(-20);
    expect(mode()).toBe('second 10');
    await player.seek(9e12);
    expect(player.at_ms).toBe(player.ended_ms);
    await player.seek(0);
    expect(mode()).toBe('second 0');
  });

  it('shows the moment that was asked for last, whichever answer comes last', async () => {
    const { player, mode } = playing();
    await player.open();
    await Promise.all([player.seek(1_010_000), player.seek(1_040_000)]);
    expect(mode()).toBe('second 40');
    expect(player.isLoading).toBe(false);
  });

  it('stops at the end, and begins anew when it is played again', async () => {
    const { player } = playing();
    await player.open(1_059_500);
    player.togglePlaying();
    player.advance(0);
    await settled();
    player.advance(5000);
    expect(player.isPlaying).toBe(false);
    expect(player.at_ms).toBe(1_060_000);
    player.togglePlaying();
    await settled();
    expect(player.at_ms).toBe(1_000_000);
  });

  it('follows a session that goes on', async () => {
    const { player, station } = playing();
    await player.open();
    station.ended_ms += 30_000;
    player.advance(6000);
    await settled();
    expect(player.ended_ms).toBe(1_090_000);
  });

  it('shows another session from its beginning', async () => {
    const { player } = playing();
    await player.open();
    await player.choose('old');
    expect(player.at_ms).toBe(500_000);
  });

  it('says why there is nothing, and recovers', async () => {
    const { player, station } = playing();
    station.isAway = true;
    await player.open();
    expect(player.failure).toBe('The station does not answer.');
    station.isAway = false;
    await player.open();
    expect(player.failure).toBe('');
    const without = new Player(
      new Archive(() => Promise.resolve(Response.json({ detail: 'No history.', hint: 'Use --store.' }, { status: 404 }))),
      { name: '' },
    );
    await without.open();
    expect(without.failure).toBe('No history. Use --store.');
  });

  it('has the site of the station, where a map without vehicles begins', async () => {
    const { player, stores } = playing();
    await player.open();
    expect(stores.session.site).toEqual(YARD);
  });

  it('commands nobody', async () => {
    const { player, stores } = playing();
    await player.open();
    const reply = await stores.session.request({ type: 'stop_script' });
    expect(reply.ok).toBe(false);
    expect(reply.error?.message).toBe('This is the past.');
  });
});
