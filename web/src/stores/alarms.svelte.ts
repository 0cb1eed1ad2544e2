import { groupAlarms, knownAlarms, newAlarms, type AlarmGroup, type KnownAlarm } from '../lib/alarms';
import { Announcer, type Voices } from '../lib/announcer';
import type { Alarms, ServerMessage } from '../lib/protocol';
import type { FleetStore } from './fleet.svelte';
import type { Receiver, Session } from './session.svelte';
import type { Settings } from './settings.svelte';

/** What an operator must be told without having looked, and the sounds that tell it. */
export class AlarmsStore implements Receiver {
  readonly feeds = ['alarms'];
  list = $state.raw<KnownAlarm[]>([]);
  /** Sound is wanted, and the browser keeps it off until somebody touches the page. */
  isMuted = $state(false);
  private readonly announcer: Announcer;

  constructor(
    private readonly session: Session,
    private readonly fleet: FleetStore,
    private readonly settings: Settings,
    private readonly voices: Voices,
  ) {
    this.announcer = new Announcer(voices, () => settings);
    if (settings.sound) this.wakeSound();
  }

  /** Of one kind together; none of a station that is lost. */
  get groups(): AlarmGroup[] {
    return this.session.isLost ? [] : this.groupsOf(this.list);
  }

  /** Those that nobody has acknowledged. */
  get open(): KnownAlarm[] {
    return this.list.filter(({ acknowledged_by }) => !acknowledged_by);
  }

  received(message: ServerMessage, now: number): void {
    if (message.type === 'alarms') this.note(message, now);
  }

  lost(wasLive: boolean): void {
    if (wasLive) this.announcer.tell('critical', 'Station lost', performance.now());
  }

  ticked(now: number): void {
    this.isMuted = this.settings.sound && this.voices.isMuted;
    const open = this.session.isLost ? [] : this.open;
    this.announcer.remind(open.some(({ severity }) => severity === 'critical') ? 'critical' : open[0]?.severity, now);
  }

  async acknowledge(numbers: number[]): Promise<void> {
    await this.session.request({ type: 'acknowledge_alarms', numbers });
  }

  /** To be called from within a click or a key. */
  wakeSound(): void {
    if (this.settings.sound) this.voices.wake();
  }

  /** What an alarm sounds like, for who has just chosen it. */
  trySound(): void {
    this.voices.wake();
    this.announcer.tell('warning', 'Alarms are spoken like this', performance.now());
  }

  private note({ alarms }: Alarms, now: number): void {
    const news = newAlarms(this.list, alarms);
    this.list = knownAlarms(alarms, now);
    for (const { severity, title } of this.groupsOf(knownAlarms(news, now))) this.announcer.tell(severity, title, now);
  }

  private groupsOf(alarms: KnownAlarm[]): AlarmGroup[] {
    return groupAlarms(alarms, (id) => this.fleet.nameOf(id));
  }
}
