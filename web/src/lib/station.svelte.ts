import { groupAlarms, knownAlarms, newAlarms, type AlarmGroup, type KnownAlarm } from './alarms';
import { Announcer, BrowserVoices } from './announcer';
import { Connection } from './connection';
import { addPictures, extendTrail, mergeUpdates, type Fleet } from './fleet';
import { appendLines } from './log';
import { settings } from './settings.svelte';
import { USUAL_LIMITS, type BatteryLimits } from './status';
import { VehicleParameters } from './parameters.svelte';
import { parseScripts } from './parse';
import {
  PROTOCOL,
  type Action,
  type Alarms,
  type Command,
  type CommandDetails,
  type Diagnostic,
  type Emergency,
  type LogLine,
  type Picture,
  type Position,
  type Reply,
  type Request,
  type Script,
  type ServerMessage,
  type StopAction,
  type Task,
} from './protocol';
import { rememberToken, socketUrl, takeToken } from './token';

/** locked: the station is there and asks for a token that this browser does not have. */
export type Phase = 'connecting' | 'live' | 'lost' | 'locked';

const CLOCK_MS = 500;

/** The station as the app sees it: what its messages have told, and whether they still come. */
class Station {
  phase = $state<Phase>('connecting');
  /** This browser's clock in ms, ticking slowly, for ages on the screen. */
  now = $state(performance.now());
  lastHeard = $state(performance.now());
  fleet = $state.raw<Fleet>(new Map());
  trails = $state.raw<Map<string, Position[]>>(new Map());
  plans = $state.raw<Map<string, Position[]>>(new Map());
  /** Where each vehicle has taken pictures. */
  pictures = $state.raw<Map<string, Picture[]>>(new Map());
  trees = $state.raw<Task[]>([]);
  script = $state.raw<Script>({ name: '', state: 'idle', message: '', source: '', diagnostics: [] });
  log = $state.raw<LogLine[]>([]);
  site = $state.raw<{ name: string; origin?: Position; tiles?: string }>({ name: '' });
  /** What this viewer is called as a commander; empty where vehicles cannot be commanded. */
  operator = $state('');
  commands = $state.raw<Command[]>([]);
  emergency = $state.raw<Emergency>({ latched: false, action: 'hold', by: '', vehicles: [] });
  alarms = $state.raw<KnownAlarm[]>([]);
  batteryLimits = $state.raw<BatteryLimits>(USUAL_LIMITS);
  /** Sound is wanted, and the browser keeps it off until somebody touches the page. */
  isMuted = $state(false);
  /** Why the last command or handover was refused; empty when it was not. */
  objection = $state('');
  /** When an emergency stop, or its release, was asked for that the station has not answered yet; by this browser's clock in ms. */
  stopAsked = $state<number | undefined>();
  /** Why the last of them was not taken, or the stop of a script did not reach the station: told wherever the operator looks. */
  stopProblem = $state.raw<{ what: string; why: string } | undefined>();
  /** Scripts in the station's folder, by name. */
  scripts = $state.raw<string[]>([]);
  version = $state('');
  /** The last thing to be told at once, for screen readers. */
  alert = $state('');
  /** Why the last request was refused; empty when it was not. */
  refusal = $state.raw<{ message: string; hint: string; diagnostics: Diagnostic[] } | undefined>(undefined);

  private readonly parameters = new Map<string, VehicleParameters>();
  private readonly voices = new BrowserVoices();
  private readonly announcer = new Announcer(this.voices, () => settings);
  private lastSeq = 0;
  /** The station's clock in s at this browser's 0. */
  private clockOffset_s = 0;
  private token: string | undefined;
  private connection: Connection;
  /** Ends what is asked over HTTP when the station is lost. */
  private asking = new AbortController();

  constructor() {
    this.token = takeToken(location, sessionStorage, history);
    this.connection = new Connection(() => new WebSocket(socketUrl(location, this.token)) as never, {
      opened: () => {},
      received: (message) => this.receive(message),
      lost: () => this.lose(),
    });
    setInterval(() => this.tick(), CLOCK_MS);
    if (settings.sound) this.wakeSound();
    for (const event of ['pointerdown', 'keydown'])
      addEventListener(event, () => settings.sound && this.wakeSound(), { capture: true, passive: true });
    this.connection.connect();
  }

  private tick(): void {
    this.now = performance.now();
    this.isMuted = settings.sound && this.voices.isMuted;
    const open = this.isLost ? [] : this.alarms.filter(({ acknowledged_by }) => !acknowledged_by);
    this.announcer.remind(open.some(({ severity }) => severity === 'critical') ? 'critical' : open[0]?.severity, this.now);
  }

  /** Seconds since anything came from the station. */
  get silence_s(): number {
    return Math.max(0, this.now - this.lastHeard) / 1000;
  }

  wakeSound(): void {
    this.voices.wake();
  }

  /** What an alarm sounds like, for who has just chosen it. */
  trySound(): void {
    this.announcer.tell('warning', 'Alarms are spoken like this', performance.now());
  }

  groupsOf(alarms: KnownAlarm[]): AlarmGroup[] {
    return groupAlarms(alarms, (id) => this.fleet.get(id)?.fields.name || id);
  }

  async acknowledge(numbers: number[]): Promise<void> {
    await this.connection.request({ type: 'acknowledge_alarms', numbers });
  }

  /** What is shown is old. */
  get isLost(): boolean {
    return this.phase === 'lost' || this.phase === 'locked';
  }

  get hasToken(): boolean {
    return this.token !== undefined;
  }

  unlock(token: string): void {
    this.token = token;
    rememberToken(token, sessionStorage);
    this.phase = 'connecting';
    this.connection.connect();
  }

  get origin(): Position | undefined {
    if (this.site.origin) return this.site.origin;
    for (const vehicle of this.fleet.values()) if (vehicle.fields.home) return vehicle.fields.home;
    return undefined;
  }

  retry(): void {
    this.connection.connect();
  }

  async start(name: string, source: string): Promise<boolean> {
    return this.noteRefusal(await this.connection.request({ type: 'start_script', name, source }));
  }

  async stop(): Promise<boolean> {
    const reply = await this.connection.request({ type: 'stop_script' });
    if (!reply.ok && this.phase !== 'live') this.stopProblem = { what: 'STOP', why: reasonOf(reply) };
    return this.noteRefusal(reply);
  }

  async command(action: Action, vehicles: string[], details: CommandDetails = {}, take_over = false): Promise<boolean> {
    return this.noteObjection(await this.connection.request({ type: 'command', action, vehicles, ...details, take_over }));
  }

  /** Without an action: the one that is latched, else what the station is set to. */
  async emergencyStop(action?: StopAction): Promise<boolean> {
    return this.askToStop(action === 'terminate' ? 'Motors off' : 'E-STOP', { type: 'emergency_stop', ...(action && { action }) });
  }

  async releaseEmergencyStop(): Promise<boolean> {
    return this.askToStop('Release', { type: 'release_emergency_stop' });
  }

  private async askToStop(what: string, request: Request): Promise<boolean> {
    if (this.phase === 'lost') this.retry();
    this.stopAsked = performance.now();
    const reply = await this.connection.request(request);
    this.stopAsked = undefined;
    this.stopProblem = reply.ok ? undefined : { what, why: reasonOf(reply) };
    if (this.stopProblem) this.alert = `${what} failed. ${this.stopProblem.why}`;
    return reply.ok;
  }

  async changeControl(type: 'request_control' | 'yield_control' | 'keep_control', vehicle: string): Promise<boolean> {
    return this.noteObjection(await this.connection.request({ type, vehicle }));
  }

  /** Seconds until the station's clock shows `time_s`, not less than 0. */
  secondsUntil(time_s: number): number {
    return Math.max(0, time_s - (this.clockOffset_s + this.now / 1000));
  }

  private noteObjection(reply: Reply): boolean {
    this.objection = reply.ok ? '' : reasonOf(reply);
    if (this.objection) this.alert = this.objection;
    return reply.ok;
  }

  /** The text of a script in the station's folder; nothing when it cannot be had, which `refusal` then explains. */
  async open(name: string): Promise<string | undefined> {
    const answer = await this.ask(`/api/v1/scripts/text?name=${encodeURIComponent(name)}`);
    if (answer?.ok) return ((await answer.json()) as { source: string }).source;
    this.refusal = {
      message: `${name} cannot be opened.`,
      hint: answer ? 'It may have been removed.' : 'The station did not answer.',
      diagnostics: [],
    };
    this.alert = this.refusal.message;
    return undefined;
  }

  private async listScripts(): Promise<void> {
    const answer = await this.ask('/api/v1/scripts');
    const body: unknown = answer?.ok ? await answer.json().catch(() => undefined) : undefined;
    if (body !== undefined) this.scripts = parseScripts(body);
  }

  /** That vehicle's parameters, as far as anybody here has asked for them. */
  parametersOf(vehicle: string): VehicleParameters {
    const known = this.parameters.get(vehicle) ?? new VehicleParameters(vehicle, (address, init) => this.ask(address, init));
    this.parameters.set(vehicle, known);
    return known;
  }

  private async ask(address: string, init: RequestInit = {}): Promise<Response | undefined> {
    const headers = new Headers(init.headers);
    if (this.token) headers.set('Authorization', `Bearer ${this.token}`);
    try {
      return await fetch(address, { ...init, headers, signal: this.asking.signal });
    } catch {
      return undefined;
    }
  }

  private noteRefusal(reply: Reply): boolean {
    this.refusal = reply.ok
      ? undefined
      : { message: reply.error?.message ?? '', hint: reply.error?.hint ?? '', diagnostics: reply.diagnostics ?? [] };
    if (this.refusal) this.alert = this.refusal.message;
    return reply.ok;
  }

  private lose(): void {
    if (this.phase === 'live') {
      this.alert = 'Station lost. The vehicles carry on; what you see is old.';
      this.announcer.tell('critical', 'Station lost', performance.now());
    }
    if (this.phase !== 'locked') this.phase = 'lost';
    this.asking.abort();
    this.asking = new AbortController();
    void this.askWhetherLocked();
  }

  /** A browser does not tell why a WebSocket was refused; the same question over HTTP does. */
  private async askWhetherLocked(): Promise<void> {
    const answer = await this.ask('/api/v1/status');
    if (answer?.status !== 401 || this.phase === 'live') return;
    this.connection.stop();
    this.phase = 'locked';
    this.alert = 'This station asks for its token.';
  }

  private receive(message: ServerMessage): void {
    const now = performance.now();
    this.lastHeard = now;
    switch (message.type) {
      case 'hello':
        if (this.phase === 'lost') this.alert = 'The station is back.';
        if (message.protocol !== PROTOCOL) this.alert = `The station speaks protocol ${message.protocol}: reload this page.`;
        this.phase = 'live';
        this.site = message.site;
        this.version = message.version;
        this.operator = message.operator ?? '';
        void this.listScripts();
        break;
      case 'vehicles':
        this.clockOffset_s = message.time_s - now / 1000;
        this.fleet = mergeUpdates(this.fleet, message.vehicles, message.full, now);
        this.growTrails();
        break;
      case 'plan':
        this.plans = new Map(this.plans).set(message.vehicle, message.path);
        break;
      case 'pictures':
        this.pictures = addPictures(this.pictures, message.vehicle, message.pictures, message.full);
        break;
      case 'tasks':
        this.trees = message.trees;
        break;
      case 'script':
        this.script = message;
        break;
      case 'log':
        this.addLog(message.lines);
        break;
      case 'emergency':
        this.noteEmergency(message);
        break;
      case 'commands':
        this.commands = message.commands;
        break;
      case 'alarms':
        this.noteAlarms(message, now);
        break;
    }
  }

  private noteAlarms({ alarms, battery }: Alarms, now: number): void {
    const news = newAlarms(this.alarms, alarms);
    this.alarms = knownAlarms(alarms, now);
    if (battery) this.batteryLimits = battery;
    for (const { severity, title } of this.groupsOf(knownAlarms(news, now))) this.announcer.tell(severity, title, now);
  }

  private noteEmergency(emergency: Emergency): void {
    if (emergency.latched && !this.emergency.latched) this.alert = `Emergency stop by ${emergency.by}. Nothing moves until it is released.`;
    if (!emergency.latched && this.emergency.latched) this.alert = `Emergency stop released by ${emergency.by}.`;
    // It was heard all the same.
    if (this.stopProblem?.what === (emergency.latched ? 'E-STOP' : 'Release')) this.stopProblem = undefined;
    this.emergency = emergency;
  }

  private growTrails(): void {
    const trails = new Map<string, Position[]>();
    for (const { id, fields } of this.fleet.values()) {
      if (fields.position) trails.set(id, extendTrail(this.trails.get(id) ?? [], fields.position));
    }
    this.trails = trails;
  }

  private addLog(lines: LogLine[]): void {
    const newest = lines.at(-1)?.seq ?? 0;
    if (newest < this.lastSeq) this.lastSeq = 0; // the station was started anew
    const before = this.log.length;
    this.log = appendLines(this.log, lines, this.lastSeq);
    // Alarms are told by themselves.
    const failure = lines.findLast((line) => line.level === 'error' && line.seq > this.lastSeq && line.source !== 'alarm');
    if (failure && before > 0) this.alert = `${failure.source}: ${failure.text}`;
    this.lastSeq = newest;
  }
}

function reasonOf({ error }: Reply): string {
  return [error?.message, error?.hint].filter(Boolean).join(' ');
}

export const station = new Station();
