// What each test has: a station of its own, pages of it in the worker's browser, and an account of what went wrong in them.
import assert from 'node:assert/strict';
import { test as base } from '@playwright/test';
import { startWorld } from './world.mjs';
import { preparePage, startFleet, startStation } from './harness.mjs';

export const test = base.extend({
  /** What the pages complained of fails the test, unless it says that complaints are due: of a station that is gone, a browser tells. */
  complaints: async ({}, use) => use({ areDue: false, heard: [] }),

  /** The station, and a new one on its port: `station()` is the one that runs, or ran last. */
  stations: async ({}, use) => {
    let station = await startStation();
    await use({ station: () => station, restart: async (token) => (station = await startStation(station.port, token)) });
    await station.stop();
  },
  station: async ({ stations }, use) => use(stations.station),
  restart: async ({ stations }, use) => use(stations.restart),

  /** The program itself with a simulated copter, for `open({ url })`. */
  fleet: async ({}, use) => {
    const fleet = await startFleet('copter:1');
    await use(fleet);
    await fleet.stop();
  },

  /** The program itself with a map on which something lies, and base maps of each kind; one for all tests of a worker. */
  world: [
    async ({}, use) => {
      const world = await startWorld();
      await use(world);
      await world.stop();
    },
    { scope: 'worker', timeout: 60_000 },
  ],

  open: async ({ context, station, complaints }, use) => {
    await use(async ({ url, hash = '', isSharp = false, ...options } = {}) => {
      const page = await context.newPage();
      // Drawn by the processor, the map takes most of a test's time. Where nobody looks at it, it is drawn coarsely and does not glide.
      await preparePage(page, { isCoarse: !isSharp, reducedMotion: isSharp ? 'no-preference' : 'reduce', ...options }, complaints.heard);
      await page.goto((url ?? station().url) + hash);
      return page;
    });
    const heard = [...complaints.heard]; // before the station ends, of which the pages would complain
    await context.close();
    if (!complaints.areDue) assert.deepEqual(heard, []);
  },
});
