import { History, type Sample } from '../lib/places/history';
import type { FleetStore } from './fleet.svelte';
import type { Receiver } from './session.svelte';

/** How the vehicles did in the last minutes, for charts. */
export class HistoryStore implements Receiver {
  readonly feeds = [];
  /** Grows with each second that was noted: what is kept grows in place. */
  private revision = $state(0);
  private readonly kept = new History();

  constructor(private readonly fleet: FleetStore) {}

  of(id: string): readonly Sample[] {
    void this.revision;
    return [...this.kept.of(id)]; // or who follows it would take it for the same
  }

  ticked(now: number): void {
    if (this.kept.note(this.fleet.vehicles.values(), now)) this.revision += 1;
  }
}
