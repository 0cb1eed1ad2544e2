// Takes the pictures of docs/guide/first-mission.md with the script that stands there. usage: node e2e/guide-pictures.mjs
// needs the built program (LAPWING, default build/release/bin/lapwing) and web/dist.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { startBrowser } from './harness.mjs';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const program = process.env.LAPWING ?? path.join(root, 'build/release/bin/lapwing');
const guide = readFileSync(path.join(root, 'docs/guide/first-mission.md'), 'utf8');
const script = guide.split('```')[1].trimStart();
const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-guide-'));
writeFileSync(path.join(folder, 'my.dolphin'), script);

const arguments_ = ['demo', '--script', 'my.dolphin', '--port', '0'];
const child = spawn(program, arguments_, { cwd: folder, env: { ...process.env, LAPWING_HOME: root }, stdio: ['ignore', 'ignore', 'pipe'] });
const browser = await startBrowser();
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
  const { page, complaints } = await browser.open(url, { scheme: 'light', size: { width: 1280, height: 720 } });
  const picture = (name) => page.screenshot({ path: path.join(root, 'docs/pictures', name) });
  await page.locator('#vehicles tr', { hasText: 'copter 1' }).getByText(/item [45]/).waitFor({ timeout: 60_000 });
  await page.waitForTimeout(1000);
  await picture('first-mission.png');

  await page.locator('#script .chip', { hasText: 'done' }).waitFor({ timeout: 120_000 });
  await page.getByRole('button', { name: 'Edit' }).click();
  await page.getByLabel('Script text').fill(script.replace('takeOff', 'takeoff'));
  await page.locator('#script').getByRole('button', { name: 'Start' }).click();
  await page.getByText('did you mean takeOff?').first().click();
  await picture('first-mission-mistake.png');
  if (complaints.length > 0) throw new Error(complaints.join('\n'));
} finally {
  await browser.stop();
  child.kill('SIGINT');
  rmSync(folder, { recursive: true, force: true });
}
