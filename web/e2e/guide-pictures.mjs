// Takes the pictures of README.md, docs/guide/first-mission.md and docs/guide/fleet.md, of the scripts that they tell of.
// usage: node e2e/guide-pictures.mjs; needs the built program (LAPWING, default build/release/bin/lapwing) and web/dist.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { startBrowser } from './harness.mjs';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const program = process.env.LAPWING ?? path.join(root, 'build/release/bin/lapwing');
const browser = await startBrowser();

/** Shows a running demo to `look`, in a browser window. */
async function withDemo(folder, demoArguments, options, look) {
  const child = spawn(program, ['demo', ...demoArguments, '--port', '0'], {
    cwd: folder,
    env: { ...process.env, LAPWING_HOME: root },
    stdio: ['ignore', 'ignore', 'pipe'],
  });
  try {
    const url = await new Promise((resolve, reject) => {
      let said = '';
      child.stderr.on('data', (data) => {
        said += data;
        const address = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
        if (address) resolve(address[0]);
      });
      child.once('exit', (code) => reject(new Error(`${program} ended with ${code}: ${said}`)));
    });
    const { page, complaints } = await browser.open(url, options);
    await look(page, (name, more) => page.screenshot({ path: path.join(root, 'docs/pictures', name), ...more }));
    if (complaints.length > 0) throw new Error(complaints.join('\n'));
  } finally {
    child.kill('SIGINT');
  }
}

const size = { width: 1280, height: 720 };
const vehicle = (page, name) => page.locator('#vehicles [role=option]', { hasText: name });
const atItem = async (page, items) => {
  await vehicle(page, 'copter 1').click();
  await page.locator('#selected .drawer', { hasText: items }).waitFor({ timeout: 180_000 });
};
const guide = readFileSync(path.join(root, 'docs/guide/first-mission.md'), 'utf8');
const script = guide.match(/```(?:dolphin)?\n([\s\S]*?)```/)[1];
const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-guide-'));
try {
  await withDemo(root, [], { scheme: 'dark', size: { width: 1440, height: 810 } }, async (page, picture) => {
    await atItem(page, /item 9/);
    await picture('map.png');

    const panel = page.locator('#parameters');
    await page.getByRole('tab', { name: /^Parameters/ }).click();
    await panel.getByRole('button', { name: 'Fetch parameters' }).click();
    await panel.getByLabel('Filter by name').fill('rtl');
    await panel.getByRole('button', { name: 'Change RTL_' }).first().click();
    await picture('parameters.png', { clip: await panel.boundingBox() });
  });

  writeFileSync(path.join(folder, 'my.dolphin'), script);
  await withDemo(folder, ['--script', 'my.dolphin'], { scheme: 'light', size }, async (page, picture) => {
    await atItem(page, /item [45]/);
    await picture('first-mission.png');

    await page.getByRole('tab', { name: /^Script/ }).click();
    await page.locator('#script .chip', { hasText: 'done' }).waitFor({ timeout: 120_000 });
    await page.getByRole('button', { name: 'Edit' }).click();
    await page.getByLabel('Script text').fill(script.replace('takeOff', 'takeoff'));
    await page.locator('#script').getByRole('button', { name: 'Start' }).click();
    await page.getByText('did you mean takeOff?').first().click();
    await picture('first-mission-mistake.png');
  });
} finally {
  await browser.stop();
  rmSync(folder, { recursive: true, force: true });
}
