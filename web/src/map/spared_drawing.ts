import type { Map as MapLibreMap } from 'maplibre-gl';

type Painter = MapLibreMap['painter'];

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
