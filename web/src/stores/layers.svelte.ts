import type { Position, ServerMessage } from '../lib/protocol';
import { Trails } from '../lib/trails';
import type { FleetStore } from './fleet.svelte';
import type { Receiver, Session } from './session.svelte';

/** What lies on the map beside the vehicles themselves. */
export class LayersStore implements Receiver {
  readonly feeds = ['vehicles', 'plans'];
  plans = $state.raw<Map<string, Position[]>>(new Map());
  /** Trails grow in place, a point at a time; `trailRevision` tells that they have. */
  readonly trails = new Trails();
  trailRevision = $state(0);

  constructor(
    private readonly session: Session,
    private readonly fleet: FleetStore,
  ) {}

  /** Of the local grid: the site's, else the first home. */
  get origin(): Position | undefined {
    if (this.session.site.origin) return this.session.site.origin;
    for (const { fields } of this.fleet.vehicles.values()) if (fields.home) return fields.home;
    return undefined;
  }

  received(message: ServerMessage): void {
    if (message.type === 'vehicles') {
      if (this.trails.grow(this.fleet.vehicles.values())) this.trailRevision += 1;
    } else if (message.type === 'plan') {
      this.plans = new Map(this.plans).set(message.vehicle, message.path);
    }
  }
}
