// Takes pictures of the app for a person to look at. usage: node e2e/pictures.mjs FOLDER [NAME]
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
  { name: 'phone', scheme: 'dark', size: { width: 390, height: 844 }, before: select },
  { name: 'phone-light', scheme: 'light', size: { width: 390, height: 844 } },
  { name: 'tablet', scheme: 'dark', size: { width: 768, height: 1024 }, before: select },
  { name: 'tablet-light', scheme: 'light', size: { width: 768, height: 1024 } },
  { name: 'field', scheme: 'light', size: { width: 1024, height: 768 }, before: select },
  { name: 'field-dark', scheme: 'dark', size: { width: 1024, height: 768 } },
  { name: 'selected', scheme: 'dark', before: select },
  { name: 'layers', scheme: 'light', before: (page) => page.getByRole('tab', { name: 'Layers' }).click() },
  { name: 'command', scheme: 'dark', size: { width: 1280, height: 800 }, before: command },
  { name: 'command-900', scheme: 'light', size: { width: 900, height: 800 }, before: command },
  { name: 'parameters', scheme: 'dark', size: { width: 1280, height: 800 }, before: parameters },
  { name: 'emergency', scheme: 'dark', size: { width: 1280, height: 800 }, before: stopAll },
];
async function select(page) {
  await page.locator('#vehicles [role=option]', { hasText: 'copter 1' }).click();
}
/** Several vehicles commanded, with what each made of it. */
async function command(page) {
  const row = (name) => page.locator('#vehicles [role=option]', { hasText: name });
  await row('copter 2').click();
  for (const name of ['plane 3', 'rover 5']) await row(name).click({ modifiers: ['Shift'] });
  await page.locator('#command').getByRole('button', { name: 'Arm', exact: true }).hover();
  await page.mouse.down();
  await page.locator('.button.held').waitFor();
  await page.locator('.button.held').waitFor({ state: 'detached' });
  await page.mouse.up();
  await page.locator('#command details tr', { hasText: 'plane 3' }).getByText('refused').waitFor();
}
/** Fetched, filtered, and one about to be changed. */
async function parameters(page) {
  await page.locator('#vehicles [role=option]', { hasText: 'copter 2' }).click();
  const panel = page.locator('#parameters');
  await page.getByRole('tab', { name: /^Parameters/ }).click();
  await panel.getByRole('button', { name: 'Fetch parameters' }).click();
  await panel.getByLabel('Filter by name').fill('alt');
  await panel.getByRole('button', { name: 'Change RTL_ALT' }).click();
}
async function stopAll(page) {
  await page.getByRole('button', { name: 'E-STOP' }).click();
  await page
    .getByRole('region', { name: 'Emergency stop' })
    .getByText(/4 of \d stopped/)
    .waitFor();
}

try {
  const pages = [];
  for (const shot of SHOTS.filter(({ name }) => name.includes(process.argv[3] ?? '')))
    pages.push({ ...shot, ...(await browser.open(station.url, shot)) });
  await pages[0].page.waitForTimeout(Number(process.env.WAIT_S ?? 20) * 1000); // trails grow
  for (const { name, page, complaints, before } of pages) {
    await page.bringToFront();
    await before?.(page);
    await page.keyboard.press('f');
    await page.waitForTimeout(1500);
    await page.screenshot({ path: path.join(folder, `${name}.png`) });
    if (complaints.length > 0) console.log(name, complaints);
  }
} finally {
  await browser.stop();
  await station.stop();
}
