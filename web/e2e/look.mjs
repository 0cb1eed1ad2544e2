// Looks at a station that runs: usage: node e2e/look.mjs URL VEHICLE [PICTURE.png]
// Prints as JSON whether that vehicle is in the map's view, how many vehicles the list has, and what the page complained of.
import { startBrowser } from './harness.mjs';

const [url, name, picture] = process.argv.slice(2);
const browser = await startBrowser();
const { page, complaints } = await browser.open(url);
page.setDefaultTimeout(30_000);
const line = page.locator('#vehicles [role=option]', { hasText: name });
await line.waitFor();
const id = (await line.getAttribute('id')).split('-').at(-1);
const look = (vehicle) => {
  const place = document.querySelector('.map').placeOf?.(vehicle);
  if (!place) return { isInView: false };
  const view = document.querySelector('.maplibregl-map').getBoundingClientRect();
  const { x, y } = place;
  return { isInView: x > view.left && x < view.right && y > view.top && y < view.bottom };
};
// The view has come to rest when what is looked at is in it, at the latest after ten seconds.
const inView = await page
  .waitForFunction(`(${look})(${JSON.stringify(id)}).isInView`, undefined, { timeout: 10_000 })
  .catch(() => undefined);
const seen = { isInView: inView !== undefined, rows: await page.locator('#vehicles [role=option]').count() };
if (picture) await page.screenshot({ path: picture });
await browser.stop();
console.log(JSON.stringify({ ...seen, complaints }));
