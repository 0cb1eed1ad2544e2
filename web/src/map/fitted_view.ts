import type { LngLat, Map as MapLibreMap } from 'maplibre-gl';
import { contains, cover, widenedBy, type Bounds, type LonLat } from './geometry';
import type { Sides } from './aim';

/** Between what is shown and the panels, in px. */
const MARGIN_PX = 48;
/** Who leaves the sight goes on to do so: the view grows by this share more, not at each message a little. */
const SPARE = 0.2;
/** Who lies so far from the panels is in sight; less than the margin, or who lies at it would move the map for nothing. */
const CLEAR_PX = 20;

/** The view keeps everything in sight until the operator takes it over; fitting gives it back. */
export class FittedView {
  follows = true;
  /** What is in sight, and of it what had to be. */
  private fitted: Bounds | undefined;
  private needed: Bounds | undefined;

  constructor(
    private readonly covered: () => Sides,
    private readonly mayAnimate: () => boolean,
  ) {}

  keepInSight(map: MapLibreMap, bounds: Bounds): void {
    if (!this.follows || (this.fitted && contains(this.fitted, bounds))) return;
    const needed = this.needed ? cover(this.needed, bounds) : bounds;
    this.show(map, this.needed ? widenedBy(needed, SPARE) : bounds, this.needed !== undefined);
    this.needed = needed;
  }

  show(map: MapLibreMap, bounds: Bounds, animate: boolean): void {
    this.fitted = this.needed = bounds;
    const { top, right, bottom, left } = this.covered();
    map.fitBounds([bounds.west, bounds.south, bounds.east, bounds.north], {
      padding: { top: top + MARGIN_PX, right: right + MARGIN_PX, bottom: bottom + MARGIN_PX, left: left + MARGIN_PX },
      maxZoom: 19,
      animate: animate && this.mayAnimate(),
      duration: 500,
    });
  }

  /** What is shown need not stay in sight. */
  forget(): void {
    this.fitted = this.needed = undefined;
  }

  /** Brings a place into the middle of what is in sight. */
  centre(map: MapLibreMap, at: LonLat): void {
    const { x, y } = map.project(at);
    const [middleX, middleY] = this.middlePx(map);
    const by: [number, number] = [x - middleX, y - middleY];
    if (Math.hypot(...by) >= 1) map.panBy(by, { animate: false });
  }

  /** About the middle of what is in sight. */
  zoom(map: MapLibreMap, steps: number): void {
    map.easeTo({ zoom: map.getZoom() + steps, around: this.middle(map), animate: this.mayAnimate(), duration: 200 });
  }

  /** Of what the panels leave of the map. */
  middle(map: MapLibreMap): LngLat {
    return map.unproject(this.middlePx(map));
  }

  private middlePx(map: MapLibreMap): [number, number] {
    const { clientWidth, clientHeight } = map.getContainer();
    const { top, right, bottom, left } = this.covered();
    return [(left + clientWidth - right) / 2, (top + clientHeight - bottom) / 2];
  }

  /** Moves the map as far as it takes to have a place in sight beside the panels. */
  reveal(map: MapLibreMap, at: LonLat): void {
    const { x, y } = map.project(at);
    const { clientWidth, clientHeight } = map.getContainer();
    const { top, right, bottom, left } = this.covered();
    const beyond = (place: number, low: number, high: number): number =>
      Math.min(0, place - low - CLEAR_PX) + Math.max(0, place - high + CLEAR_PX);
    const by: [number, number] = [beyond(x, left, clientWidth - right), beyond(y, top, clientHeight - bottom)];
    if (by[0] !== 0 || by[1] !== 0) map.panBy(by, { animate: this.mayAnimate(), duration: 300 });
  }

  /** Panels cover more of the map: while the view keeps everything in sight, what they hide comes out again. */
  uncover(map: MapLibreMap): void {
    if (!this.follows || !this.fitted) return;
    const { west, south, east, north } = this.fitted;
    const [upper, lower] = [map.project([west, north]), map.project([east, south])];
    const { clientWidth, clientHeight } = map.getContainer();
    const { right, bottom } = this.covered();
    const isHidden = lower.x > clientWidth - right || lower.y > clientHeight - bottom || upper.x < 0 || upper.y < 0;
    const { needed } = this;
    if (isHidden) this.show(map, this.fitted, true);
    this.needed = needed;
  }
}
