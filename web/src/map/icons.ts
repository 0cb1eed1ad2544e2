import type { Map as MapLibreMap } from 'maplibre-gl';
import type { Family } from '../lib/protocol';
import type { Level } from '../lib/status';
import type { MapColours } from './colours';
import { SHAPES } from './shapes';

const VEHICLE_PX = 36;
const BADGE_PX = 18;
const HOME_PX = 20;
const BADGES: Partial<Record<Level, string>> = { warning: '▲', critical: '✖', lost: '?' };

export const vehicleIcon = (family: Family, level: Level): string => `vehicle ${family} ${level}`;
/** What stands beside a vehicle that needs attention; nothing beside others. */
export const badgeIcon = (level: Level): string => (BADGES[level] ? `badge ${level}` : '');
export const HOME_ICON = 'home';

/** Of the map's own style: twice its size, to be sharp on dense screens. */
const STYLE_PIXELS = 2;

/** Draws the icons that the map's style asks for, in the colours that the map has then. */
export function offerIcons(map: MapLibreMap, colours: () => MapColours): void {
  map.on('styleimagemissing', ({ id }) => {
    if (id !== HOME_ICON || map.hasImage(id)) return;
    const { image } = drawIcon(id, colours(), STYLE_PIXELS);
    const data = image.getContext('2d')?.getImageData(0, 0, image.width, image.height);
    if (data) map.addImage(id, data, { pixelRatio: STYLE_PIXELS });
  });
}

/** An icon by its name, so many times as dense as the page; `size` is in px of the page. */
export function drawIcon(id: string, colours: MapColours, pixels: number): { image: HTMLCanvasElement; size: number } {
  const [kind, a, b] = id.split(' ');
  if (kind === 'vehicle') return drawn(VEHICLE_PX, pixels, (on) => drawVehicle(on, SHAPES[a as Family], b as Level, colours));
  if (kind === 'badge') return drawn(BADGE_PX, pixels, (on) => drawBadge(on, a as Level, colours));
  return drawn(HOME_PX, pixels, (on) => drawHome(on, colours));
}

function drawn(size: number, pixels: number, draw: (on: CanvasRenderingContext2D) => void): { image: HTMLCanvasElement; size: number } {
  const image = document.createElement('canvas');
  image.width = image.height = Math.ceil(size * pixels);
  const context = image.getContext('2d');
  context?.scale(pixels, pixels);
  if (context) draw(context);
  return { image, size };
}

/** Cased, to be seen on any ground. What nobody has heard of for long is an outline. */
function drawVehicle(on: CanvasRenderingContext2D, shape: string, level: Level, { panel, levels }: MapColours): void {
  const path = new Path2D(shape);
  on.translate((VEHICLE_PX - 32) / 2, (VEHICLE_PX - 32) / 2);
  on.lineJoin = 'round';
  on.lineWidth = level === 'lost' ? 5 : 3.5;
  on.strokeStyle = panel;
  on.stroke(path);
  on.fillStyle = level === 'lost' ? panel : levels[level];
  on.fill(path);
  if (level !== 'lost') return;
  on.globalAlpha = 0.35;
  on.fillStyle = levels.lost;
  on.fill(path);
  on.globalAlpha = 1;
  on.lineWidth = 1.8;
  on.strokeStyle = levels.lost;
  on.stroke(path);
}

function drawBadge(on: CanvasRenderingContext2D, level: Level, { panel, levels }: MapColours): void {
  const middle = BADGE_PX / 2;
  on.fillStyle = panel;
  disc(on, middle, middle);
  on.fillStyle = levels[level];
  disc(on, middle, middle - 1.5);
  on.fillStyle = panel;
  letter(on, BADGES[level] ?? '', 10, middle);
}

function drawHome(on: CanvasRenderingContext2D, { panel, label }: MapColours): void {
  const middle = HOME_PX / 2;
  on.fillStyle = panel;
  on.strokeStyle = label;
  on.lineWidth = 2;
  on.beginPath();
  on.roundRect(1.5, 1.5, HOME_PX - 3, HOME_PX - 3, 4.5);
  on.fill();
  on.stroke();
  on.fillStyle = label;
  letter(on, 'H', 11, middle);
}

function disc(on: CanvasRenderingContext2D, middle: number, radius: number): void {
  on.beginPath();
  on.arc(middle, middle, radius, 0, 2 * Math.PI);
  on.fill();
}

function letter(on: CanvasRenderingContext2D, text: string, size: number, middle: number): void {
  on.font = `700 ${size}px system-ui, 'DejaVu Sans', sans-serif`;
  on.textAlign = 'center';
  on.textBaseline = 'middle';
  on.fillText(text, middle, middle + 0.5);
}
