// Glass to glass in a browser: from the moment of exposure until a page can show the picture, by WebRTC and as MJPEG, a row a way.
// usage: node bench/video/browser.mjs [--seconds 30] [--rates 10,30]
//
// The camera is the test pattern, whose hand goes round once a second, over lapwing-perceive and lapwing-stream, seen by a page that shows
// nothing else, in Debian's Chromium without a GPU. Before each of its frames the browser copies what the page shows, and the hand in it
// says when it was taken; the first frame with another hand is when that picture came. For WebRTC it also tells how far the delay that
// the app would write on the picture, of its RTP time, is from that.
import { createServer, request } from 'node:http';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const { startCamera } = await import(path.join(root, 'web/e2e/camera.mjs'));
const { default: config } = await import(path.join(root, 'web/playwright.config.js'));
const { chromium } = createRequire(path.join(root, 'web/package.json'))('@playwright/test');
const { values } = parseArgs({ options: { seconds: { type: 'string', default: '30' }, rates: { type: 'string', default: '10,30' } } });

/** In the page: shows the camera as `way` has it. */
async function show({ way, whep }) {
  if (way === 'MJPEG') {
    document.body.append(Object.assign(new Image(), { id: 'shown', src: '/raw.mjpg' }));
    return;
  }
  const video = document.createElement('video');
  Object.assign(video, { id: 'shown', autoplay: true, muted: true });
  document.body.append(video);
  const connection = new RTCPeerConnection({ iceServers: [] });
  const { receiver } = connection.addTransceiver('video', { direction: 'recvonly' });
  receiver.jitterBufferTarget = 0; // as the app asks
  await connection.setLocalDescription();
  const answer = await window[whep](connection.localDescription.sdp);
  await connection.setRemoteDescription({ type: 'answer', sdp: answer });
  video.srcObject = new MediaStream([receiver.track]);
  const turn = 2 ** 32 / 90;
  const each = (_, { rtpTimestamp, expectedDisplayTime }) => {
    const shown = performance.timeOrigin + Math.max(expectedDisplayTime, performance.now());
    window.written = (((shown - rtpTimestamp / 90) % turn) + turn) % turn;
    video.requestVideoFrameCallback(each);
  };
  video.requestVideoFrameCallback(each);
}

/** In the page: the delays of pictures as they come. */
function sample(milliseconds) {
  const [width, height] = [640, 480];
  // Of the hand, as src/video/camera/pattern_camera.cpp draws it.
  const [middleX, middleY] = [0.5 * width, 0.4 * height];
  const radii = [0.16, 0.2, 0.24, 0.28].map((radius) => radius * height);
  const canvas = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  const hand = () => {
    const { data } = canvas.getImageData(0, 0, width, height);
    let [x, y] = [0, 0];
    for (let step = 0; step < 720; step += 1) {
      const angle = (2 * Math.PI * step) / 720;
      for (const radius of radii) {
        const [column, row] = [Math.round(middleX + radius * Math.sin(angle)), Math.round(middleY - radius * Math.cos(angle))];
        const weight = Math.max(0, data[4 * (row * width + column) + 1] - 100); // the disc behind it is dark
        x += weight * Math.sin(angle);
        y += weight * Math.cos(angle);
      }
    }
    return (Math.atan2(x, y) / (2 * Math.PI) + 1) % 1;
  };
  return new Promise((resolve) => {
    const found = [];
    const shown = document.getElementById('shown');
    const ends = performance.now() + milliseconds;
    let last = -1;
    const look = () => {
      const now = performance.timeOrigin + performance.now();
      canvas.drawImage(shown, 0, 0, width, height);
      const at = hand();
      const moved = Math.abs(at - last);
      if (last < 0 || Math.min(moved, 1 - moved) > 0.008) {
        if (last >= 0) found.push({ delay: 1000 * ((((now / 1000 - at) % 1) + 1) % 1), written: window.written });
        last = at;
      }
      if (performance.now() < ends) requestAnimationFrame(look);
      else resolve(found);
    };
    requestAnimationFrame(look);
  });
}

/** A page of its own, which has the MJPEG from where it comes from itself: what is of elsewhere no canvas gives back. */
async function startPage(pictures) {
  const server = createServer((asked, answer) => {
    if (asked.url !== '/raw.mjpg') return answer.setHeader('Content-Type', 'text/html').end('<!doctype html><body></body>');
    const from = request({ host: '127.0.0.1', port: pictures, path: asked.url }, (given) => {
      given.socket.setNoDelay(true);
      answer.socket.setNoDelay(true);
      answer.writeHead(given.statusCode, given.headers);
      given.pipe(answer);
    });
    answer.once('close', () => from.destroy());
    return from.end();
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return server;
}

const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
const ms = (value) => `${Math.round(value)} ms`;

async function row(way, rate) {
  const camera = await startCamera({ pictures_a_s: rate });
  const server = await startPage(camera.pictures);
  const browser = await chromium.launch(config.use.launchOptions);
  try {
    const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
    await page.exposeFunction('whep', async (body) => (await camera.whep('/api/v1/whep/raw', { method: 'POST', body })).text());
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.evaluate(show, { way, whep: 'whep' });
    await page.waitForFunction(() => {
      const { naturalWidth, videoWidth } = document.getElementById('shown');
      return (naturalWidth || videoWidth) > 0;
    });
    await page.waitForTimeout(2000); // it settles
    const before = camera.cpuSeconds();
    const found = await page.evaluate(sample, 1000 * Number(values.seconds));
    const used = camera.cpuSeconds() - before;
    const delays = found.map(({ delay }) => delay).sort((a, b) => a - b);
    const off = found.flatMap(({ delay, written }) => (written === undefined ? [] : [written - delay])).sort((a, b) => a - b);
    const written = off.length ? `${ms(share(off, 0.5))} (${ms(share(off, 0.05))} to ${ms(share(off, 0.95))})` : '';
    const quantiles = [0.5, 0.95, 0.99].map((part) => ms(share(delays, part)));
    const cost = way === 'WebRTC' ? `${((1000 * used) / delays.length).toFixed(1)} ms` : '';
    console.log(`| ${[way, rate, delays.length, ...quantiles, ms(delays.at(-1)), written, cost].join(' | ')} |`);
  } finally {
    await browser.close();
    server.closeAllConnections();
    server.close();
    await camera.stop();
  }
}

console.log(`glass to glass in Chromium, 640x480, load at the start ${os.loadavg()[0].toFixed(1)}`);
console.log("| way | pictures asked a second | pictures | p50 | p95 | p99 | most | written on it, less that | stream's processor time a picture |");
console.log('|---|---|---|---|---|---|---|---|---|');
for (const rate of values.rates.split(',').map(Number)) for (const way of ['WebRTC', 'MJPEG']) await row(way, rate);
