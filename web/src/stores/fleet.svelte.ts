import { mergeUpdates, type Fleet, type Vehicle } from '../lib/fleet';
import type { ServerMessage } from '../lib/protocol';
import { USUAL_LIMITS, type BatteryLimits } from '../lib/status';
import { VehicleParameters } from './vehicle_parameters.svelte';
import type { Receiver, Session } from './session.svelte';

/** The vehicles, each with the last that is known of it. */
export class FleetStore implements Receiver {
  readonly feeds = ['vehicles', 'alarms'];
  vehicles = $state.raw<Fleet>(new Map());
  batteryLimits = $state.raw<BatteryLimits>(USUAL_LIMITS);
  private readonly parameters = new Map<string, VehicleParameters>();

  constructor(private readonly session: Session) {}

  received(message: ServerMessage, now: number): void {
    if (message.type === 'vehicles')
      this.vehicles = mergeUpdates(this.vehicles, message.vehicles, message.full, now, (site) => this.session.anchorOf(site));
    if (message.type === 'alarms' && message.battery) this.batteryLimits = message.battery;
  }

  get(id: string): Vehicle | undefined {
    return this.vehicles.get(id);
  }

  nameOf(id: string): string {
    return this.vehicles.get(id)?.fields.name || id;
  }

  /** That vehicle's parameters, as far as anybody here has asked for them. */
  parametersOf(vehicle: string): VehicleParameters {
    const known = this.parameters.get(vehicle) ?? new VehicleParameters(vehicle, (address, init) => this.session.ask(address, init));
    this.parameters.set(vehicle, known);
    return known;
  }
}
