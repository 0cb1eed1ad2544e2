// Looks at a station that runs: usage: node e2e/look.mjs URL VEHICLE [PICTURE.png]
// Prints as JSON whether that vehicle's marker is in the map's view, how many vehicles the table has, and what the page complained of.
import { startBrowser } from './harness.mjs';

const [url, name, picture] = process.argv.slice(2);
const browser = await startBrowser();
const { page, complaints } = await browser.open(url);
page.setDefaultTimeout(30_000);
await page.locator('#vehicles tbody tr', { hasText: name }).waitFor();
const marker = page.locator(`.vehicle[aria-label^="${name}"]`);
await marker.waitFor();
const look = (label) => {
  const box = document.querySelector(`.vehicle[aria-label^="${label}"]`).getBoundingClientRect();
  const view = document.querySelector('.maplibregl-map').getBoundingClientRect();
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  return { isInView: x > view.left && x < view.right && y > view.top && y < view.bottom };
};
// The view has come to rest when what is looked at is in it, at the latest after ten seconds.
const inView = await page
  .waitForFunction(`(${look})(${JSON.stringify(name)}).isInView`, undefined, { timeout: 10_000 })
  .catch(() => undefined);
const seen = { isInView: inView !== undefined, rows: await page.locator('#vehicles tbody tr').count() };
if (picture) await page.screenshot({ path: picture });
await browser.stop();
console.log(JSON.stringify({ ...seen, complaints }));
