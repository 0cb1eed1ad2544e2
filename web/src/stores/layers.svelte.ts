import type { Frame } from '../connection/frame';
import type { Position, ServerMessage } from '../lib/protocol';
import { Tracks } from '../lib/places/tracks';
import { Trails } from '../lib/places/trails';
import type { FleetStore } from './fleet.svelte';
import type { Receiver, Session } from './session.svelte';

/** What lies on the map beside the vehicles themselves. */
export class LayersStore implements Receiver {
  readonly feeds = ['vehicles', 'plans'];
  plans = $state.raw<Map<string, Position[]>>(new Map());
  /** Trails grow in place, a point at a time; `trailRevision` tells that they have. */
  readonly trails = new Trails();
  trailRevision = $state(0);
  /** New only when it is another place: what follows it would be drawn anew at each message. */
  private firstHome = $state.raw<Position | undefined>();

  private readonly tracks = new Tracks();

  constructor(
    private readonly session: Session,
    private readonly fleet: FleetStore,
  ) {
    session.follow('map.tracks', (frame) => this.take(frame));
  }

  /** Of the local grid: the site's, else the first home. */
  get origin(): Position | undefined {
    return this.session.site.origin ?? this.firstHome;
  }

  received(message: ServerMessage): void {
    if (message.type === 'vehicles') {
      // In the past vehicles are told of now and then only: where they went in between stands in their tracks.
      if (this.session.isPast) this.trailRevision += 1;
      else if (this.trails.grow(this.fleet.vehicles.values())) this.trailRevision += 1;
      this.noteHome();
    } else if (message.type === 'plan') {
      this.plans = new Map(this.plans).set(message.vehicle, message.path);
    }
  }

  /** What the station knows of where vehicles have been, for who comes later; what follows shows in where they are. */
  private take(frame: Frame): void {
    const vehicles = this.tracks.take(frame);
    if (!frame.whole && !this.session.isPast) return;
    for (const vehicle of vehicles) this.trails.replace(vehicle, this.tracks.of(vehicle));
    this.trailRevision += 1;
  }

  private noteHome(): void {
    let home: Position | undefined;
    for (const { fields } of this.fleet.vehicles.values()) home ??= fields.home;
    const { firstHome: before } = this;
    if (home?.lat_deg !== before?.lat_deg || home?.lon_deg !== before?.lon_deg) this.firstHome = home;
  }
}
