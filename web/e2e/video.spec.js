// What a drone's camera sees, as video in the browser, from the programs that are on a drone; the station, of which Playwright plays the
// part that hands offers on, is made up. And what the page does where there is no video.
import assert from 'node:assert/strict';
import { expect } from '@playwright/test';
import { startCamera } from './camera.mjs';
import { test as base } from './fixtures.js';
import { openPanel } from './page.js';
import { planPicture } from './world.mjs';

const drone = { name: 'hawk', connected: true, words: [] };
const withDrone = (message) =>
  message.type === 'vehicles' ? [{ type: 'survey', feed: 'survey', revision: 1, whole: true, drones: [drone] }, message] : [message];

const test = base.extend({
  /** `camera(options)`: the drone's programs, which all pages of this test reach. */
  camera: async ({ context }, use) => {
    const started = [];
    await use(async (options) => {
      const camera = await startCamera(options);
      started.push(camera);
      await context.route('**/api/v1/survey/hawk/video*', async (route) => {
        const view = new URL(route.request().url()).searchParams.get('view');
        const answer = await camera
          .whep(`/api/v1/whep/${view}`, { method: 'POST', body: route.request().postData() })
          .catch(() => undefined);
        const session = answer?.headers.get('Location')?.split('/').at(-1);
        await route.fulfill({
          status: answer?.status ?? 409,
          contentType: answer?.headers.get('Content-Type') ?? 'application/problem+json',
          body: answer ? await answer.text() : '{"detail":"FailedToSend: nobody answers"}',
          headers: session ? { Location: `/api/v1/survey/hawk/video/${session}`, 'Lapwing-Now-Ms': String(Date.now()) } : {},
        });
      });
      await context.route('**/api/v1/survey/hawk/video/*', async (route) => {
        const session = new URL(route.request().url()).pathname.split('/').at(-1);
        const answer = await camera.whep(`/api/v1/whep/sessions/${session}`, { method: 'DELETE' }).catch(() => undefined);
        await route.fulfill({ status: answer?.status ?? 409, contentType: 'application/json', body: '{}' });
      });
      let number = 0;
      await context.route('**/api/v1/survey/hawk/picture*', (route) =>
        route.fulfill({
          body: planPicture(),
          contentType: 'image/png',
          headers: { 'Lapwing-Number': String((number += 1)), 'Lapwing-Age-Ms': '80' },
        }),
      );
      return camera;
    });
    for (const camera of started) await camera.stop();
  },
});

const video = (panel) => panel.locator('.camera video:not(.waits)');

/** Opens the camera of the page's only drone; gives back the panel that has it. */
async function look(page) {
  const panel = await openPanel(page, 'Survey');
  await panel.getByRole('button', { name: 'Camera' }).click();
  return panel;
}

/** How many pictures a video shows until `count`, with how bright they are on the average. */
const seen = (panel, count) =>
  video(panel).evaluate(
    (element, wanted) =>
      new Promise((resolve) => {
        const canvas = new OffscreenCanvas(64, 48).getContext('2d');
        const pictures = [];
        const each = (_, { rtpTimestamp }) => {
          canvas.drawImage(element, 0, 0, 64, 48);
          const { data } = canvas.getImageData(0, 0, 64, 48);
          pictures.push({ rtpTimestamp, bright: data.reduce((sum, value) => sum + value, 0) / data.length });
          if (pictures.length === wanted) resolve(pictures);
          else element.requestVideoFrameCallback(each);
        };
        element.requestVideoFrameCallback(each);
      }),
    count,
  );

test('shows both views as video with the delay written on it', async ({ open, camera }) => {
  await camera({ token: 'swordfish' });
  const panel = await look(await open({ station: withDrone }));
  await expect(video(panel)).toBeVisible();
  const pictures = await seen(panel, 10);
  assert.equal(new Set(pictures.map(({ rtpTimestamp }) => rtpTimestamp)).size, 10, 'each was taken at a time of its own');
  assert.ok(
    pictures.every(({ bright }) => bright > 70),
    'the pattern, and not a black picture',
  );
  await expect(panel.locator('.delay')).toHaveText(/^\d{1,4} ms$/);
  await expect(panel.getByText('Single pictures')).toHaveCount(0);
  await expect(panel.locator('.camera img')).toHaveCount(0);
  await panel.getByRole('button', { name: 'Plain' }).click();
  await expect(video(panel)).toBeVisible();
  await seen(panel, 15);
  await expect(panel.locator('.delay')).toHaveText(/^\d{1,3} ms$/);
});

test('gives a place again when the viewer looks no more', async ({ open, camera }) => {
  await camera({ most_viewers: 1 });
  const page = await open({ station: withDrone });
  const panel = await look(page);
  await expect(video(panel)).toBeVisible();
  await panel.getByRole('button', { name: 'Camera' }).click();
  await panel.getByRole('button', { name: 'Camera' }).click();
  await expect(video(panel)).toBeVisible();
});

test('gives the place again of a page that was closed', async ({ open, camera, complaints }) => {
  await camera({ most_viewers: 1 });
  const first = await open({ station: withDrone });
  await expect(video(await look(first))).toBeVisible();
  await first.close();
  complaints.areDue = true; // it may be told that all places are taken
  const panel = await openPanel(await open({ station: withDrone }), 'Survey');
  await expect(async () => {
    await panel.getByRole('button', { name: 'Camera' }).click();
    if (await panel.locator('.camera video').isHidden()) await panel.getByRole('button', { name: 'Camera' }).click();
    await expect(video(panel)).toBeVisible({ timeout: 4000 });
  }).toPass({ timeout: 60_000 });
});

test('says that all places are taken, and shows single pictures', async ({ open, camera, complaints }) => {
  await camera({ most_viewers: 1 });
  const first = await look(await open({ station: withDrone }));
  await expect(video(first)).toBeVisible();
  complaints.areDue = true; // the browser tells of each answer that is none
  const second = await look(await open({ station: withDrone }));
  await expect(second.getByText('Single pictures, no video: as many look at the camera as it allows')).toBeVisible();
  await expect(second.getByRole('img', { name: 'What hawk sees' })).toBeVisible();
});

test('goes on with single pictures when the video ends', async ({ open, camera, complaints }) => {
  complaints.areDue = true;
  const { endVideo } = await camera();
  const panel = await look(await open({ station: withDrone }));
  await expect(video(panel)).toBeVisible();
  await endVideo();
  await expect(panel.getByRole('img', { name: 'What hawk sees' })).toBeVisible();
  await expect(panel.getByText(/^Single pictures, no video: (the (video stands still|drone is not reached)|FailedToSend)/)).toBeVisible();
});
