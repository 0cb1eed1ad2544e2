import type { MapColours } from './colours';
import { drawIcon } from './icons';

type Canvas = HTMLCanvasElement;

export interface Stamp {
  image: Canvas;
  /** In px of the page. */
  width: number;
  height: number;
}

/** Texts come and go with heights and modes: more of them than are in sight need not be kept. */
const MOST = 2000;
const HALO_PX = 3;

/** Icons and texts that were drawn once, to be put down wherever they are needed: to draw a text anew costs ten times as much. */
export class Stamps {
  private readonly kept = new Map<string, Stamp>();
  private readonly ruler = document.createElement('canvas').getContext('2d');

  constructor(
    readonly colours: MapColours,
    readonly pixels: number,
  ) {}

  icon(id: string): Stamp {
    return this.get(id, () => {
      const { image, size } = drawIcon(id, this.colours, Math.max(1, this.pixels));
      return { image, width: size, height: size };
    });
  }

  /** With a halo of the ground, to be read on whatever lies below. */
  text(words: string, size: number, weight: number, colour: string): Stamp {
    return this.get(`text ${size} ${weight} ${colour} ${words}`, () =>
      this.draw(words, `${weight} ${size}px system-ui, sans-serif`, size, colour),
    );
  }

  private draw(words: string, font: string, size: number, colour: string): Stamp {
    if (this.ruler) this.ruler.font = font;
    const width = Math.ceil(this.ruler?.measureText(words).width ?? 0) + 2 * HALO_PX;
    const height = Math.ceil(size * 1.25) + 2;
    const pixels = Math.max(1, this.pixels);
    const image = document.createElement('canvas');
    [image.width, image.height] = [width * pixels, height * pixels];
    const on = image.getContext('2d');
    if (!on) return { image, width, height };
    on.scale(pixels, pixels);
    on.font = font;
    on.textBaseline = 'middle';
    on.lineJoin = 'round';
    on.lineWidth = HALO_PX;
    on.strokeStyle = this.colours.ground;
    on.strokeText(words, HALO_PX, height / 2);
    on.fillStyle = colour;
    on.fillText(words, HALO_PX, height / 2);
    return { image, width, height };
  }

  private get(key: string, make: () => Stamp): Stamp {
    const known = this.kept.get(key);
    if (known) return known;
    if (this.kept.size >= MOST) this.kept.clear();
    const made = make();
    this.kept.set(key, made);
    return made;
  }
}
