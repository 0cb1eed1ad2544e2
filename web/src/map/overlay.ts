import { MercatorCoordinate, type Map as MapLibreMap } from 'maplibre-gl';
import type { MapColours } from './colours';
import type { LonLat } from './geometry';
import type { Box } from './labels';
import { Stamps } from './stamps';

export interface Point {
  x: number;
  y: number;
}

/** What is drawn on, in px of the page. */
export interface Paper {
  readonly on: CanvasRenderingContext2D;
  readonly width: number;
  readonly height: number;
  readonly colours: MapColours;
  readonly stamps: Stamps;
  readonly place: (at: LonLat) => Point;
  /** What has been written so far: labels give way to it. */
  readonly taken: Box[];
}

/** Draws what moves on it; whether it moves on by itself, and wants the next frame, too. */
export type Paint = (paper: Paper, now: number) => boolean;

/**
 * A sheet above the map for what moves. The map below is one picture: to draw it anew costs a machine without a GPU a tenth of a second,
 * however little has moved, and this sheet some milliseconds.
 */
export class Overlay {
  private readonly canvas = document.createElement('canvas');
  private readonly context = this.canvas.getContext('2d');
  private stamps: Stamps | undefined;
  private frame = 0;
  /** The map has moved, and with its next picture the sheet goes along. */
  private isShifted = false;

  constructor(
    private readonly map: MapLibreMap,
    private readonly colours: () => MapColours,
    private readonly paint: Paint,
  ) {
    this.canvas.className = 'overlay';
    this.canvas.setAttribute('aria-hidden', 'true');
    map.getCanvas().after(this.canvas);
    map.on('move', () => (this.isShifted = true));
    map.on('resize', () => (this.isShifted = true));
    map.on('render', () => this.isShifted && this.draw(performance.now()));
  }

  /** Something on it has changed: it is drawn with the next frame. */
  wantsPaint(): void {
    this.frame ||= requestAnimationFrame((now) => this.draw(now));
  }

  remove(): void {
    cancelAnimationFrame(this.frame);
    this.canvas.remove();
  }

  private draw(now: number): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.isShifted = false;
    const { context: on } = this;
    if (!on) return;
    const { clientWidth: width, clientHeight: height } = this.map.getContainer();
    const pixels = this.fitTo(width, height);
    on.setTransform(pixels, 0, 0, pixels, 0, 0);
    on.clearRect(0, 0, width, height);
    const colours = this.colours();
    if (this.stamps?.colours !== colours || this.stamps.pixels !== pixels) this.stamps = new Stamps(colours, pixels);
    if (this.paint({ on, width, height, colours, stamps: this.stamps, place: projection(this.map), taken: [] }, now)) this.wantsPaint();
  }

  private fitTo(width: number, height: number): number {
    const pixels = devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * pixels), Math.round(height * pixels)];
    if (this.canvas.width !== wide || this.canvas.height !== high) [this.canvas.width, this.canvas.height] = [wide, high];
    return pixels;
  }
}

/** A layer's paint on a sheet of its own, which is laid on as clearly as the layer is wanted: what lies on itself there does not shine through. */
export function paintFaded(paint: Paint, paper: Paper, opacity: number, now: number): boolean {
  const sheet = document.createElement('canvas');
  const { canvas } = paper.on;
  [sheet.width, sheet.height] = [canvas.width, canvas.height];
  const on = sheet.getContext('2d');
  if (!on) return false;
  on.setTransform(paper.on.getTransform());
  const goesOn = paint({ ...paper, on }, now);
  paper.on.globalAlpha = opacity;
  paper.on.drawImage(sheet, 0, 0, paper.width, paper.height);
  paper.on.globalAlpha = 1;
  return goesOn;
}

/** As the map places things, much faster: a flat map that is seen from above is a turn, a scale and a shift of the projection. */
function projection(map: MapLibreMap): (at: LonLat) => Point {
  const centre = MercatorCoordinate.fromLngLat(map.getCenter());
  const origin = map.project(centre.toLngLat());
  const step = 1e-4;
  const along = (x: number, y: number): Point => {
    const { x: px, y: py } = map.project(new MercatorCoordinate(centre.x + x, centre.y + y).toLngLat());
    return { x: (px - origin.x) / step, y: (py - origin.y) / step };
  };
  const [east, south] = [along(step, 0), along(0, step)];
  return ([lon, lat]) => {
    const dx = (lon + 180) / 360 - centre.x;
    const dy = 0.5 - Math.log(Math.tan(Math.PI / 4 + (lat * Math.PI) / 360)) / (2 * Math.PI) - centre.y;
    return { x: origin.x + east.x * dx + south.x * dy, y: origin.y + east.y * dx + south.y * dy };
  };
}
