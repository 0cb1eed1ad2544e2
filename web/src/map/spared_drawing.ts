import type { Map as MapLibreMap } from 'maplibre-gl';

type Painter = MapLibreMap['painter'];

/** Where a picture takes long, it waits so long for tiles that are on their way; how often it looks whether they are there. */
const PATIENCE_MS = 300;
const LOOK_MS = 8;

/**
 * Keeps the library from drawing what nobody sees: a sky, which a map that is seen from above has none of, and the masks by which lines and
 * areas end at their tile. It draws those anew for each layer whose source is another, twice a picture, also for layers that are empty,
 * though all of them have the same tiles. A GPU does not mind; without one that was four fifths of the time that a picture took.
 */
export function spareDrawing(map: MapLibreMap): void {
  const spare = (): void => sparePainter(map.painter);
  spare();
  map.on('webglcontextrestored', spare); // which makes a new painter
}

export function sparePainter(painter: Painter): void {
  painter.drawFunctions = { ...painter.drawFunctions, sky: () => undefined };
  const drawMasks = painter._renderTileClippingMasks.bind(painter);
  painter._renderTileClippingMasks = (layer, tiles, isTexture) => {
    // What has drawn over the masks has left no source there.
    const areThere: unknown = painter.currentStencilSource;
    if (!isTexture && areThere !== undefined && layer.isTileClipped() && areMasked(painter, tiles))
      painter.currentStencilSource = layer.source;
    else drawMasks(layer, tiles, isTexture);
  };
}

/** Whether the masks that were drawn last are those of these tiles. */
function areMasked({ _tileClippingMaskIDs: masks }: Painter, tiles: readonly { readonly key: string }[] | undefined): boolean {
  return !!tiles?.length && tiles.length === Object.keys(masks).length && tiles.every(({ key }) => key in masks);
}

/** What of a map asks for pictures of it, and knows what is missing in them. */
interface Gathered {
  triggerRepaint(): void;
  isMoving(): boolean;
  on(event: 'move' | 'resize', listener: () => void): unknown;
  readonly style?: { readonly tileManagers: Readonly<Record<string, { loaded(): boolean }>> };
}

/**
 * Has a map draw what comes from its workers in one picture. By itself it draws for each tile of each source anew, half a dozen times
 * for one change of some sources; where a picture takes long, the last of them comes seconds later. A map that is moved goes along at once.
 */
export function gatherPictures(map: Gathered, isSlow: () => boolean, later: (look: () => void, ms: number) => void = setTimeout): void {
  const draw = map.triggerRepaint.bind(map);
  let left_ms = 0;
  const isComplete = (): boolean => Object.values(map.style?.tileManagers ?? {}).every((tiles) => tiles.loaded());
  const look = (): void => {
    if (left_ms <= 0) return;
    left_ms -= LOOK_MS;
    if (left_ms > 0 && !isComplete()) return later(look, LOOK_MS);
    left_ms = 0;
    draw();
  };
  map.triggerRepaint = () => {
    if (!isSlow() || map.isMoving() || isComplete()) draw();
    else if (left_ms <= 0) later(look, ((left_ms = PATIENCE_MS), LOOK_MS));
  };
  // Also where it is moved at one go.
  for (const event of ['move', 'resize'] as const) map.on(event, draw);
}
