import type { Frame } from '../connection/frame';
import type { Session } from './session.svelte';

/** What has come of a feed. */
export interface Followed<T> {
  readonly content: T;
}

/** What the feeds of the map's layers have told, for as long as the page lives: a layer that is made anew finds it here. */
export class FeedsStore {
  private readonly contents = new Map<string, Content<unknown>>();

  constructor(private readonly session: Session) {}

  /** Has the station send that feed; `take` makes of what there is, and of a message, what there is then, always as a new value. */
  follow<T>(feed: string, empty: T, take: (content: T, frame: Frame) => T): Followed<T> {
    const known = this.contents.get(feed) as Content<T> | undefined;
    if (known) return known;
    const made = new Content(empty);
    this.contents.set(feed, made);
    this.session.follow(feed, (frame) => (made.content = take(frame.whole ? empty : made.content, frame)));
    return made;
  }
}

class Content<T> implements Followed<T> {
  content = $state.raw(undefined as T);

  constructor(empty: T) {
    this.content = empty;
  }
}
