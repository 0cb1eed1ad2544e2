import type { LonLat } from '../map/geometry';
import type { Paper, Point } from '../map/overlay';

export interface Stroke {
  colour: string;
  width: number;
  dashes?: number[];
  opacity?: number;
}

/** A line on the sheet above the map, cased by what lies below it, to be seen on any ground. */
export function paintLine(
  { on, colours, place }: Paper,
  line: readonly LonLat[],
  { colour, width, dashes = [], opacity = 1 }: Stroke,
): void {
  if (line.length < 2) return;
  on.beginPath();
  line.forEach((at, index) => {
    const { x, y } = place(at);
    if (index === 0) on.moveTo(x, y);
    else on.lineTo(x, y);
  });
  on.lineJoin = 'round';
  on.globalAlpha = 0.7 * opacity;
  on.strokeStyle = colours.ground;
  on.lineWidth = width + 2.4;
  on.stroke();
  on.globalAlpha = opacity;
  on.strokeStyle = colour;
  on.lineWidth = width;
  on.setLineDash(dashes);
  on.stroke();
  on.setLineDash([]);
  on.globalAlpha = 1;
}

/** Words with their lower left corner, or their middle, at a place of the screen. */
export function paintWords(
  { on, stamps, colours, taken }: Paper,
  words: string,
  { x, y }: Point,
  align: 'corner' | 'middle',
  colour = colours.text,
): void {
  const { image, width, height } = stamps.text(words, 12, 650, colour);
  const [left, top] = align === 'corner' ? [x - 3, y - height] : [x - width / 2, y - height / 2];
  on.drawImage(image, left, top, width, height);
  taken.push({ left, top, width, height });
}
