import { bodyOf } from './files/answers';
import type { CameraView } from './camera';

/** Who can be asked over HTTP: the session. */
interface Asked {
  ask(address: string, init?: RequestInit): Promise<Response | undefined>;
}

export interface Shown {
  /** From now on it shows pictures. */
  started(): void;
  /** A picture is on the screen whose light fell in then, by this page's clock (`performance.now()`). */
  taken(taken_ms: number): void;
}

/** RTP's time of a drone's video: seconds since 1970 in 1/90000 s, of which RTP has the lower 32 bits, some 13 hours. */
const TICKS_A_MS = 90;
const TURN_MS = 2 ** 32 / TICKS_A_MS;
/** How long the first picture, or the next one, may take until something else is tried. */
const PATIENCE_MS = 5000;
const LOOK_MS = 100;

/** How long ago a picture of that RTP time was taken, where the drone's clock shows `now_ms`: the nearest time that it can mean. */
export function rtpAge(rtpTimestamp: number, now_ms: number): number {
  const behind = (now_ms - rtpTimestamp / TICKS_A_MS) % TURN_MS;
  if (behind < -TURN_MS / 2) return behind + TURN_MS;
  return behind > TURN_MS / 2 ? behind - TURN_MS : behind;
}

/**
 * Shows a drone's video (WebRTC; the station carries the offer and its answer, the drone sends the pictures) for as long as it comes and
 * `isWanted`. Gives in words why it is over, or why there is none.
 */
export async function showVideo(
  element: HTMLVideoElement,
  station: Asked,
  { drone, view }: { drone: string; view: CameraView },
  isWanted: () => boolean,
  shown: Shown,
): Promise<string> {
  if (!('RTCPeerConnection' in window) || !('requestVideoFrameCallback' in element)) return 'this browser shows no WebRTC';
  const connection = new RTCPeerConnection({ iceServers: [] });
  let session = '';
  let stream: MediaStream | undefined;
  try {
    const { receiver } = connection.addTransceiver('video', { direction: 'recvonly' });
    // The newest is wanted, not the smoothest.
    if ('jitterBufferTarget' in receiver) receiver.jitterBufferTarget = 0;
    await connection.setLocalDescription();
    const asked_ms = performance.now();
    const answer = await station.ask(`/api/v1/survey/${encodeURIComponent(drone)}/video?view=${view}`, {
      method: 'POST',
      body: connection.localDescription?.sdp ?? '',
      headers: { 'Content-Type': 'application/sdp' },
    });
    const answered_ms = performance.now();
    if (!answer?.ok) return (await bodyOf(answer)).failure;
    session = answer.headers.get('Location') ?? '';
    const sdp = await answer.text();
    // A page that has much to do learns late of an answer; the browser has noted when it came.
    const timing = performance.getEntriesByName(answer.url, 'resource').findLast((entry) => entry.startTime >= asked_ms) as
      PerformanceResourceTiming | undefined;
    // The station's clock at this page's 0; how long its answer was on the way is not known, and not in the delay.
    const begins_ms = Number.parseInt(answer.headers.get('Lapwing-Now-Ms') ?? '', 10) - (timing?.responseStart || answered_ms);
    await connection.setRemoteDescription({ type: 'answer', sdp });
    if (!isWanted()) return '';
    element.srcObject = stream = new MediaStream([receiver.track]);
    return await watch(element, connection, begins_ms, isWanted, shown);
  } catch (error) {
    return `the browser takes no video from there: ${error instanceof Error ? error.message : String(error)}`;
  } finally {
    // Another one may have begun to be shown there.
    if (stream && element.srcObject === stream) element.srcObject = null;
    // In this order: a drone that has heard the end of the connection knows no such session any more.
    if (session.startsWith('/api/v1/survey/')) await station.ask(session, { method: 'DELETE' });
    connection.close();
  }
}

/** Until no picture comes any more. */
async function watch(
  element: HTMLVideoElement,
  connection: RTCPeerConnection,
  begins_ms: number,
  isWanted: () => boolean,
  shown: Shown,
): Promise<string> {
  let last_ms = performance.now();
  let hasStarted = false;
  const each: VideoFrameRequestCallback = (_, { rtpTimestamp, expectedDisplayTime }) => {
    if (!isWanted()) return;
    last_ms = performance.now();
    if (!hasStarted) shown.started();
    hasStarted = true;
    const at_ms = Math.max(expectedDisplayTime, last_ms);
    shown.taken(rtpTimestamp === undefined ? NaN : at_ms - rtpAge(rtpTimestamp, begins_ms + at_ms));
    element.requestVideoFrameCallback(each);
  };
  element.requestVideoFrameCallback(each);
  while (isWanted()) {
    await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
    if (connection.connectionState === 'failed') return 'the drone is not reached from here over UDP';
    // A page that nobody sees is given no pictures.
    if (document.visibilityState === 'hidden') last_ms = performance.now();
    if (performance.now() - last_ms > PATIENCE_MS) return hasStarted ? 'the video stands still' : 'no picture comes over WebRTC';
  }
  return '';
}
