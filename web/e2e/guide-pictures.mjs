// Takes the pictures of README.md and of the guides, of the scripts that they tell of.
// usage: node e2e/guide-pictures.mjs [demo|first-mission|ground]; needs the built program (LAPWING, default build/release/bin/lapwing) and
// web/dist.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { startBrowser } from './harness.mjs';
import { planPicture, startWorld } from './world.mjs';

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
const script = guide.match(/```dolphin[^\n]*\n([\s\S]*?)```/)[1];
const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-guide-'));
/** The demo's map, and parameters. */
async function demo() {
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
}

/** The script of the first mission in the air, and with a mistake. */
async function firstMission() {
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
}

/** What lies on the ground: what was found, a plan that is being laid there, and what goes into a file. */
async function ground() {
  const world = await startWorld();
  try {
    const { page, complaints } = await browser.open(world.url, { scheme: 'light', size, reducedMotion: 'reduce' });
    const picture = (name) => page.screenshot({ path: path.join(root, 'docs/pictures', name) });
    await vehicle(page, 'copter 1').waitFor();
    await page.getByRole('tab', { name: /^Layers/ }).click();
    await page.getByRole('radio', { name: 'Plain', exact: true }).check();
    await page.getByRole('searchbox', { name: 'Find on the map' }).fill('door 222');
    await page.getByRole('button', { name: /^222/ }).click();
    const card = page.getByRole('article', { name: '222' });
    await card.getByRole('button', { name: /^Enlarge/, busy: false }).waitFor();
    await page.getByRole('searchbox', { name: 'Find on the map' }).fill('');
    await atRest(page);
    await picture('ground-found.png');
    await card.getByRole('button', { name: 'Close', exact: true }).click();

    await page.getByLabel('Lay a plan on the ground').setInputFiles({ name: 'office.png', mimeType: 'image/png', buffer: planPicture() });
    const sheet = page.getByRole('region', { name: 'Lay a plan on the ground' }).getByRole('application');
    await sheet.waitFor();
    const map = await page.locator('.map').boundingBox();
    const [drawer, dock] = [await page.locator('#selected').boundingBox(), await page.locator('#dock').boundingBox()];
    const middle = { x: (map.x + drawer.x) / 2, y: (map.y + dock.y) / 2 };
    const on = await sheet.boundingBox();
    const places = [[[0.01, 0.02], [-78, -48]], [[0.99, 0.02], [118, -48]], [[0.99, 0.98], [119, 69]]]; // prettier-ignore
    for (const [[u, v], [dx, dy]] of places) {
      await sheet.click({ position: { x: u * on.width, y: v * on.height } });
      await page.getByText(/^Now click the same place/).waitFor();
      await page.mouse.click(middle.x + dx, middle.y + dy);
    }
    await atRest(page);
    await picture('ground-plan.png');
    await page.getByRole('button', { name: 'Cancel' }).click();

    await page.getByRole('region', { name: 'Export' }).scrollIntoViewIfNeeded();
    await page.getByRole('region', { name: 'Export' }).getByRole('button', { name: 'Export' }).waitFor();
    await picture('ground-export.png');
    if (complaints.length > 0) throw new Error(complaints.join('\n'));
  } finally {
    await world.stop();
  }
}

/** Until the map has drawn what it has come to: the processor draws it here. */
const atRest = (page) => page.waitForTimeout(3000);

try {
  for (const take of Object.entries({ demo, 'first-mission': firstMission, ground }))
    if (!process.argv[2] || process.argv[2] === take[0]) await take[1]();
} finally {
  await browser.stop();
  rmSync(folder, { recursive: true, force: true });
}
