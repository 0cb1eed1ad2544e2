import { defineConfig } from '@playwright/test';

/**
 * Chromium heeds one list of what is to be left out, the last: so Playwright's own are named here, too. The two of the address bar are
 * pages of the browser's own that it would load beside each page of ours, and that cost half as much processor time as that.
 */
const LEFT_OUT = [
  ...['WebUIOmniboxPopup', 'WebUIOmniboxAimPopup'],
  ...['AvoidUnnecessaryBeforeUnloadCheckSync', 'BoundaryEventDispatchTracksNodeRemoval', 'DestroyProfileOnBrowserClose'],
  ...['DialMediaRouteProvider', 'GlobalMediaControls', 'HttpsUpgrades', 'LensOverlay', 'MediaRouter', 'PaintHolding'],
  ...['ThirdPartyStoragePartitioning', 'Translate', 'AutoDeElevate', 'RenderDocument', 'OptimizationHints'],
];

/**
 * The app in Debian's Chromium against a real station over made-up vehicles. A worker has one browser for all of its tests; each test
 * has a station and pages of its own. Drawing is done by the processor here, so more workers than cores do not pay.
 */
export default defineConfig({
  testDir: 'e2e',
  // Not in this folder: whatever lies here makes the app be built again.
  outputDir: '../build/e2e-results',
  fullyParallel: true,
  workers: Number(process.env.WORKERS ?? 2),
  timeout: 120_000,
  expect: { timeout: 15_000 },
  forbidOnly: true,
  // What a busy machine made late is tried once more; the account calls it flaky and says how it failed.
  retries: 1,
  reporter: [['list']],
  use: {
    actionTimeout: 30_000,
    viewport: { width: 1440, height: 900 },
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
      args: [
        '--no-sandbox',
        '--disable-gpu',
        '--enable-unsafe-swiftshader',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
        `--disable-features=${LEFT_OUT.join()}`,
      ],
    },
  },
});
