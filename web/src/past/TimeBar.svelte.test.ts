import { fireEvent, render, screen } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { flushSync } from 'svelte';
import { describe, expect, it } from 'vitest';
import { Archive } from './archive';
import { timeOf } from './clock';
import { Comparison } from './comparison.svelte';
import { Player } from './player.svelte';
import TimeBar from './TimeBar.svelte';

const began_ms = new Date(2026, 10, 22, 14, 0, 0).getTime();
const sessions = [
  { id: 'new', name: 'survey', began_ms, ended_ms: began_ms + 600_000 },
  { id: 'old', name: '', began_ms: began_ms - 9e7, ended_ms: began_ms - 8e7 },
];

async function open(answer: unknown = { sessions, frames: [], complete_to_ms: 0 }, hasPresent = true) {
  const archive = new Archive(() => Promise.resolve(Response.json(answer)));
  const player = new Player(archive, { name: 'yard' });
  const comparison = new Comparison(archive, player, () => {});
  let isLive = false;
  render(TimeBar, { player, comparison, onlive: hasPresent ? () => (isLive = true) : undefined });
  await player.open();
  flushSync();
  return { player, comparison, isLive: () => isLive };
}

describe('the time bar', () => {
  it('says which moment is shown', async () => {
    await open();
    expect(screen.getByText('14:09:00')).toBeInTheDocument();
    expect(screen.getByRole('slider', { name: 'Moment' })).toHaveAttribute('aria-valuetext', '2026-11-22 14:09:00');
  });

  it('asks for a moment once the slider is let go, and shows the time on the way', async () => {
    const { player } = await open();
    const slider = screen.getByRole('slider', { name: 'Moment' });
    const before = player.at_ms;
    await fireEvent.input(slider, { target: { value: String(began_ms + 60_000) } });
    expect(screen.getByText('14:01:00')).toBeInTheDocument();
    expect(player.at_ms).toBe(before);
    await fireEvent.change(slider, { target: { value: String(began_ms + 60_000) } });
    expect(player.at_ms).toBe(began_ms + 60_000);
  });

  it('plays, pauses, steps, changes speed and session, and goes back to live', async () => {
    const user = userEvent.setup();
    const { player, isLive } = await open();
    await user.click(screen.getByRole('button', { name: 'Play' }));
    expect(player.isPlaying).toBe(true);
    await user.click(screen.getByRole('button', { name: 'Pause' }));
    expect(player.isPlaying).toBe(false);
    await user.click(screen.getByRole('button', { name: '10 seconds back' }));
    expect(timeOf(player.at_ms)).toBe('14:08:50');
    await user.selectOptions(screen.getByRole('combobox', { name: 'Speed' }), '10');
    expect(player.speed).toBe(10);
    await user.selectOptions(screen.getByRole('combobox', { name: 'Session' }), 'old');
    expect(player.session?.id).toBe('old');
    await user.click(screen.getByRole('button', { name: 'Back to live' }));
    expect(isLive()).toBe(true);
  });

  it('compares the moment with another one, by a second handle or with now', async () => {
    const user = userEvent.setup();
    const { player, comparison } = await open();
    expect(screen.queryByRole('slider', { name: 'Compare with' })).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Compare' }));
    expect(comparison.marked).toEqual({ session: 'new', at_ms: began_ms + 540_000 });
    const mark = screen.getByRole('slider', { name: 'Compare with' });
    await fireEvent.change(mark, { target: { value: String(began_ms + 60_000) } });
    expect(comparison.marked).toEqual({ session: 'new', at_ms: began_ms + 60_000 });
    await user.click(screen.getByRole('button', { name: 'With now' }));
    expect(player.at_ms).toBe(began_ms + 600_000);
    expect(comparison.marked?.at_ms).toBe(began_ms + 60_000);
    await user.click(screen.getByRole('button', { name: 'Compare' }));
    expect(comparison.isOn).toBe(false);
  });

  it('offers no present where there is none', async () => {
    await open(undefined, false);
    expect(screen.queryByRole('button', { name: 'Back to live' })).toBeNull();
  });

  it('says what is wrong where nothing is kept', async () => {
    await open({ sessions: [] });
    expect(screen.getByRole('alert')).toHaveTextContent('Nothing is kept yet.');
    expect(screen.getByRole('button', { name: 'Play' })).toBeDisabled();
  });
});
