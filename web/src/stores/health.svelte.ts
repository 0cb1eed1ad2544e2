import { byNeed, healthOf, inNeed, type VehicleHealth } from '../lib/reports/health';
import type { Session } from './session.svelte';

/** How the modules of vehicles do, where there are such that say so. */
export class HealthStore {
  /** Who needs somebody comes first. */
  vehicles = $state.raw<readonly VehicleHealth[]>([]);

  constructor(private readonly session: Session) {
    session.follow('health', ({ content }) => this.take(byNeed(healthOf(content))));
  }

  /** How many vehicles need somebody. */
  get inNeed(): number {
    return inNeed(this.vehicles);
  }

  private take(vehicles: VehicleHealth[]): void {
    const moved = new Set(this.vehicles.filter(({ may_move }) => may_move).map(({ id }) => id));
    for (const { id, name, may_move, reason } of vehicles)
      if (!may_move && moved.has(id)) this.session.announce(`${name} stops: ${reason ?? 'a module is not well'}.`);
    this.vehicles = vehicles;
  }
}
