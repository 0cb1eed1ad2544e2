import type { Map as MapLibreMap } from 'maplibre-gl';
import { contains, cover, type Bounds } from './geometry';
import type { Sides } from './aim';

/** Between what is shown and the panels, in px. */
const MARGIN_PX = 48;

/** The view keeps everything in sight until the operator takes it over; fitting gives it back. */
export class FittedView {
  follows = true;
  private fitted: Bounds | undefined;

  constructor(
    private readonly covered: () => Sides,
    private readonly mayAnimate: () => boolean,
  ) {}

  keepInSight(map: MapLibreMap, bounds: Bounds): void {
    if (!this.follows || (this.fitted && contains(this.fitted, bounds))) return;
    this.show(map, this.fitted ? cover(this.fitted, bounds) : bounds, this.fitted !== undefined);
  }

  show(map: MapLibreMap, bounds: Bounds, animate: boolean): void {
    this.fitted = bounds;
    const { top, right, bottom, left } = this.covered();
    map.fitBounds([bounds.west, bounds.south, bounds.east, bounds.north], {
      padding: { top: top + MARGIN_PX, right: right + MARGIN_PX, bottom: bottom + MARGIN_PX, left: left + MARGIN_PX },
      maxZoom: 19,
      animate: animate && this.mayAnimate(),
      duration: 500,
    });
  }
}
