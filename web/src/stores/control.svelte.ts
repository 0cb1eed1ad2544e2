import type { Objection } from '../lib/plausibility';
import type { Action, Command, CommandDetails, Emergency, Reply, Request, ServerMessage, StopAction } from '../lib/protocol';
import { reasonOf, type Receiver, type Session } from './session.svelte';

/** What operators command and what becomes of it, the emergency stop before all. */
export class ControlStore implements Receiver {
  readonly feeds = ['control'];
  commands = $state.raw<Command[]>([]);
  emergency = $state.raw<Emergency>({ latched: false, action: 'hold', by: '', vehicles: [] });
  /** Why the last command or handover was refused; empty when it was not. */
  objection = $state('');
  /** When an emergency stop, or its release, was asked for that the station has not answered yet; by this browser's clock in ms. */
  stopAsked = $state<number | undefined>();
  /** Why the last of them was not taken, or the stop of a script did not reach the station: told wherever the operator looks. */
  stopProblem = $state.raw<{ what: string; why: string } | undefined>();

  constructor(private readonly session: Session) {}

  received(message: ServerMessage): void {
    if (message.type === 'commands') this.commands = message.commands;
    else if (message.type === 'emergency') this.noteEmergency(message);
  }

  async command(action: Action, vehicles: string[], details: CommandDetails = {}, take_over = false): Promise<boolean> {
    return this.noteObjection(await this.session.request({ type: 'command', action, vehicles, ...details, take_over }));
  }

  /** The same once more, for those vehicles that a rule refused it for, with that rule set aside. */
  async commandAnyway(
    { action, place, height_m, mode, allow }: Command,
    against: Objection,
    reason: string,
    take_over: boolean,
  ): Promise<boolean> {
    const details: CommandDetails = {
      ...(place && { lat_deg: place.lat_deg, lon_deg: place.lon_deg }),
      ...(height_m !== undefined && { height_m }),
      ...(mode && { mode }),
      allow: { ...allow, [against.rule]: reason },
    };
    return this.command(action, against.vehicles, details, take_over);
  }

  async changeControl(type: 'request_control' | 'yield_control' | 'keep_control', vehicle: string): Promise<boolean> {
    return this.noteObjection(await this.session.request({ type, vehicle }));
  }

  /** Without an action: the one that is latched, else what the station is set to. */
  async emergencyStop(action?: StopAction): Promise<boolean> {
    return this.askToStop(action === 'terminate' ? 'Motors off' : 'E-STOP', { type: 'emergency_stop', ...(action && { action }) });
  }

  async releaseEmergencyStop(): Promise<boolean> {
    return this.askToStop('Release', { type: 'release_emergency_stop' });
  }

  noteStopProblem(what: string, why: string): void {
    this.stopProblem = { what, why };
  }

  forgetStopProblem(): void {
    this.stopProblem = undefined;
  }

  private async askToStop(what: string, request: Request): Promise<boolean> {
    if (this.session.phase === 'lost') this.session.retry();
    this.stopAsked = performance.now();
    const reply = await this.session.request(request);
    this.stopAsked = undefined;
    this.stopProblem = reply.ok ? undefined : { what, why: reasonOf(reply) };
    if (this.stopProblem) this.session.announce(`${what} failed. ${this.stopProblem.why}`);
    return reply.ok;
  }

  private noteObjection(reply: Reply): boolean {
    this.objection = reply.ok ? '' : reasonOf(reply);
    if (this.objection) this.session.announce(this.objection);
    return reply.ok;
  }

  private noteEmergency(emergency: Emergency): void {
    const { latched, by } = emergency;
    if (latched && !this.emergency.latched) this.session.announce(`Emergency stop by ${by}. Nothing moves until it is released.`);
    if (!latched && this.emergency.latched) this.session.announce(`Emergency stop released by ${by}.`);
    // It was heard all the same.
    if (this.stopProblem?.what === (latched ? 'E-STOP' : 'Release')) this.stopProblem = undefined;
    this.emergency = emergency;
  }
}
