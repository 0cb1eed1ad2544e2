import type { Severity } from './protocol';

/** What it needs of the browser; tests bring their own. */
export interface Voices {
  beep(severity: Severity): void;
  speak(text: string): void;
  /** Makes ready to sound; from within a click or a key it takes effect. */
  wake(): void;
  /** Whether a sound would not be heard now. */
  readonly isMuted: boolean;
}

/** How often what is critical sounds again until somebody has acknowledged it. */
export const REPEAT_MS = 10_000;

/** Tells alarms to who does not look: once, and what is critical again and again until it is acknowledged. */
export class Announcer {
  private lastBeep = -Infinity;

  constructor(
    private readonly voices: Voices,
    private readonly wants: () => { sound: boolean; voice: boolean },
  ) {}

  /** Something new, told in these words. */
  tell(severity: Severity, words: string, now: number): void {
    const { sound, voice } = this.wants();
    if (sound) this.beep(severity, now);
    if (voice) this.voices.speak(words);
  }

  /** To be called now and then with the worst that nobody has acknowledged. */
  remind(worst: Severity | undefined, now: number): void {
    if (worst === 'critical' && this.wants().sound && now - this.lastBeep >= REPEAT_MS) this.beep('critical', now);
  }

  private beep(severity: Severity, now: number): void {
    this.lastBeep = now;
    this.voices.beep(severity);
  }
}

/** Height in Hz, begin and length in s of each tone: three quick pairs for what is critical, one low tone for the rest. */
const TONES: Record<Severity, [number, number, number][]> = {
  critical: [0, 0.45, 0.9].flatMap((start): [number, number, number][] => [
    [988, start, 0.16],
    [740, start + 0.18, 0.16],
  ]),
  warning: [[587, 0, 0.35]],
};

/** The browser's own tones and voice. A page may sound only after somebody has touched it: `isMuted` tells. */
export class BrowserVoices implements Voices {
  private context: AudioContext | undefined;

  get isMuted(): boolean {
    return this.context?.state === 'suspended';
  }

  wake(): void {
    if (typeof AudioContext === 'undefined') return;
    this.context ??= new AudioContext();
    if (this.context.state === 'suspended') void this.context.resume().catch(() => {});
  }

  beep(severity: Severity): void {
    this.wake();
    const context = this.context;
    if (!context || context.state !== 'running') return;
    for (const [height, start, length] of TONES[severity]) {
      const begin = context.currentTime + start;
      const tone = new OscillatorNode(context, { type: 'triangle', frequency: height });
      const loudness = new GainNode(context, { gain: 0 });
      // Tones that begin and end at once click.
      loudness.gain.setTargetAtTime(0.35, begin, 0.008);
      loudness.gain.setTargetAtTime(0, begin + length, 0.015);
      tone.connect(loudness).connect(context.destination);
      tone.start(begin);
      tone.stop(begin + length + 0.15);
    }
  }

  speak(text: string): void {
    if (typeof speechSynthesis === 'undefined') return;
    const words = new SpeechSynthesisUtterance(text);
    words.lang = 'en';
    speechSynthesis.speak(words);
  }
}
