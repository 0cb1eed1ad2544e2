import { render, screen, waitFor } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { ageText } from '../lib/camera';
import { TestStation } from '../testing/station';
import DroneCamera from './DroneCamera.svelte';

let station: TestStation;
let made: number;
/** What was asked for; only the first one is answered with a picture, as a camera that gives no other would have it. */
let asked: string[];
let answers: (() => Response)[];

const picture = (age_ms: number): Response =>
  new Response(new Blob(['jpeg']), { headers: { 'Lapwing-Age-Ms': String(age_ms), 'Lapwing-Number': '7' } });
const noImage = (): Response =>
  new Response('{"detail":"NoImage: the drone is reached and has given no picture for 3 s"}', { status: 504 });

beforeEach(() => {
  made = 0;
  asked = [];
  answers = [];
  URL.createObjectURL = () => `blob:${(made += 1)}`;
  URL.revokeObjectURL = () => {};
  station = TestStation.live();
  station.stores.session.ask = (address) => {
    if (address.includes('/video')) return Promise.resolve(undefined);
    asked.push(address);
    const answer = answers.shift();
    return answer ? Promise.resolve(answer()) : new Promise(() => {});
  };
});
afterEach(() => station.end());

async function open(): Promise<void> {
  render(DroneCamera, { props: { drone: 'hawk' }, context: station.context });
  expect(asked).toEqual([]);
  await userEvent.click(screen.getByRole('button', { name: 'Camera' }));
}

it('shows the picture with its delay, and asks for the one after it', async () => {
  answers = [() => picture(250)];
  await open();
  expect(await screen.findByAltText('What hawk sees')).toHaveAttribute('src', 'blob:1');
  const delay = Number.parseInt(screen.getByText(/^\d+ ms$/).textContent ?? '', 10);
  expect(delay).toBeGreaterThanOrEqual(250);
  await waitFor(() =>
    expect(asked).toEqual(['/api/v1/survey/hawk/picture?view=annotated&after=0', '/api/v1/survey/hawk/picture?view=annotated&after=7']),
  );
});

it('says plainly that nothing comes', async () => {
  answers = [noImage];
  await open();
  expect(await screen.findByText(/no image: NoImage: the drone is reached/)).toBeVisible();
  expect(screen.queryByRole('img')).toBeNull();
});

it('keeps the last picture with its growing delay when the camera stops', async () => {
  answers = [() => picture(250), noImage];
  await open();
  expect(await screen.findByText(/no image: NoImage/)).toBeVisible();
  expect(screen.getByAltText('What hawk sees')).toHaveClass('old');
  await waitFor(() => expect(Number.parseInt(screen.getByText(/^\d+ ms$/).textContent ?? '', 10)).toBeGreaterThan(300));
});

it('shows the camera plain as well, and asks for nothing once it is closed', async () => {
  await open();
  await userEvent.click(screen.getByRole('button', { name: 'Plain' }));
  expect(asked.at(-1)).toBe('/api/v1/survey/hawk/picture?view=raw&after=0');
  await userEvent.click(screen.getByRole('button', { name: 'Camera' }));
  expect(screen.queryByText('waiting for the camera')).toBeNull();
  expect(asked).toHaveLength(2);
});

it('says why there is no video, and shows single pictures', async () => {
  answers = [() => picture(250)];
  await open();
  expect(await screen.findByText('Single pictures, no video: this browser shows no WebRTC')).toBeVisible();
  expect(await screen.findByAltText('What hawk sees')).toBeVisible();
});

it('tells no delay when the clocks do not agree', () => {
  expect(ageText(-20)).toBe('0 ms');
  expect(ageText(-5000)).toMatch(/unknown/);
  expect(ageText(NaN)).toBe('delay not known');
});
