import { bodyOf } from './files/answers';

export type CameraView = 'annotated' | 'raw';

export interface CameraPicture {
  bytes: Blob;
  /** As the station counts them. */
  number: string;
  /** From the light that fell in until the station's answer, by the clocks of drone and station. */
  age_ms: number;
  /** When the answer began to arrive, by this page's clock. */
  answered_ms: number;
}

/** Who can be asked over HTTP: the session. */
interface Asked {
  ask(address: string): Promise<Response | undefined>;
}

/** The next picture of a survey drone's camera after the one of that number, or in words why there is none. */
export async function nextPicture(
  station: Asked,
  drone: string,
  view: CameraView,
  after: string,
): Promise<{ picture?: CameraPicture; failure: string }> {
  const answer = await station.ask(`/api/v1/survey/${encodeURIComponent(drone)}/picture?view=${view}&after=${after}`);
  if (!answer?.ok) return { failure: (await bodyOf(answer)).failure };
  const answered_ms = performance.now();
  const bytes = await answer.blob().catch(() => undefined);
  const age_ms = Number.parseInt(answer.headers.get('Lapwing-Age-Ms') ?? '', 10);
  const number = answer.headers.get('Lapwing-Number') ?? '';
  if (!bytes || !/^\d+$/.test(number) || Number.isNaN(age_ms)) return { failure: 'The station sends no picture.' };
  return { picture: { bytes, number, age_ms, answered_ms }, failure: '' };
}

/** Clocks that agree to a tenth of a second are good enough to show a delay; others show none that can be believed. */
const CLOCKS_AGREE_MS = 100;
const LONGEST_MS = 3_600_000;

/** The delay of a picture, to be written on it. */
export function ageText(age_ms: number): string {
  if (Number.isNaN(age_ms)) return 'delay not known';
  if (age_ms < -CLOCKS_AGREE_MS || age_ms > LONGEST_MS) return 'delay unknown: the clocks of drone and station differ';
  return `${Math.max(0, Math.round(age_ms))} ms`;
}
