import type { LonLatBox } from '../layers/found/tile_span';
import type { Changes } from '../past/changes';

/** What has changed between two moments, while somebody compares them. */
export class ChangesStore {
  shown = $state.raw<Changes | undefined>();
  /** What to look at now: a new value each time. */
  lookedAt = $state.raw<{ bounds: LonLatBox } | undefined>();

  show(changes: Changes | undefined): void {
    this.shown = changes;
    this.lookedAt = undefined;
  }

  lookAt(bounds: LonLatBox): void {
    this.lookedAt = { bounds };
  }
}
