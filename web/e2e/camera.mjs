// A survey drone's camera, which is a test pattern, and what shows it: the programs themselves.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const programs = path.join(process.env.LAPWING_BUILD ?? path.join(root, 'build/release'), 'bin');

export const freeTcpPort = () =>
  new Promise((resolve) => {
    const probe = createServer().listen(0, '127.0.0.1', () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });

async function answers(port) {
  const isThere = () =>
    new Promise((resolve) => {
      const socket = connect(port, '127.0.0.1', () => resolve(socket.destroy() !== undefined)).on('error', () => resolve(false));
    });
  while (!(await isThere())) await new Promise((resolve) => setTimeout(resolve, 50));
}

/** With a token, viewers need it. `most_viewers` look by WebRTC. */
export async function startCamera({ pictures_a_s = 10, token = '', most_viewers = 4 } = {}) {
  const folder = mkdtempSync(path.join(tmpdir(), 'lapwing-camera-'));
  const [pictures, video] = [await freeTcpPort(), await freeTcpPort()];
  const file = path.join(folder, 'onboard.toml');
  if (token) writeFileSync(path.join(folder, 'camera.token'), token, { mode: 0o600 });
  writeFileSync(
    file,
    '[bus]\ndomain = 78\n[camera]\nkind = "pattern"\nwidth = 640\nheight = 480\n' +
      '[survey]\narea = [[1, 2], [1, 2.0003], [1.0003, 2.0003]]\n' +
      `[stream]\nport = ${pictures}\npictures_a_s = ${pictures_a_s}\n${token ? 'token_file = "camera.token"\n' : ''}` +
      `[webrtc]\nport = ${video}\nmost_viewers = ${most_viewers}\n`,
  );
  const start = (name) => {
    const program = path.join(programs, `lapwing-${name}`);
    const child = spawn(program, [name, '--config', file], { cwd: folder, stdio: 'ignore' });
    const ended = new Promise((resolve) => child.once('close', resolve));
    return { pid: child.pid, kill: () => child.kill('SIGKILL'), ended };
  };
  const [perceive, stream] = [start('perceive'), start('stream')];
  await answers(pictures);
  await answers(video);
  const authorization = token ? { Authorization: `Bearer ${token}` } : {};
  return {
    pictures,
    /** A viewer's offer, or the end of its session, as a station hands it on. */
    whep: (place, init) =>
      fetch(`http://127.0.0.1:${video}${place}`, { ...init, headers: { ...authorization, 'Content-Type': 'application/sdp' } }),
    /** Processor time that what makes video has had so far. */
    cpuSeconds: () => {
      const fields = readFileSync(`/proc/${stream.pid}/stat`, 'utf8').split(')').at(-1).trim().split(' ');
      return (Number(fields[11]) + Number(fields[12])) / 100;
    },
    /** What makes video is gone. */
    endVideo: async () => {
      stream.kill();
      await stream.ended;
    },
    stop: async () => {
      for (const child of [perceive, stream]) child.kill();
      await Promise.all([perceive.ended, stream.ended]);
      rmSync(folder, { recursive: true, force: true });
    },
  };
}
