// Takes pictures of the app for a person to look at. usage: node e2e/pictures.mjs FOLDER
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import { startBrowser, startStation } from './harness.mjs';

const folder = process.argv[2] ?? 'pictures';
mkdirSync(folder, { recursive: true });
const station = await startStation();
const browser = await startBrowser();
const SHOTS = [
  { name: 'dark', scheme: 'dark' },
  { name: 'light', scheme: 'light' },
  { name: 'phone', scheme: 'dark', size: { width: 360, height: 740 } },
];
try {
  const pages = [];
  for (const shot of SHOTS) pages.push({ ...shot, ...(await browser.open(station.url, shot)) });
  await pages[0].page.waitForTimeout(Number(process.env.WAIT_S ?? 20) * 1000); // trails grow
  for (const { name, page, complaints } of pages) {
    await page.bringToFront();
    await page.keyboard.press('f');
    await page.waitForTimeout(1500);
    await page.screenshot({ path: path.join(folder, `${name}.png`) });
    if (complaints.length > 0) console.log(name, complaints);
  }
} finally {
  await browser.stop();
  await station.stop();
}
