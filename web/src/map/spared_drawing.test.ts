import { describe, expect, it, vi } from 'vitest';
import { sparePainter } from './spared_drawing';

/** A painter as far as masks go: it notes the sources for whose layers it has drawn them. */
function painter() {
  let next = 1;
  const drawn: string[] = [];
  const one = {
    drawFunctions: { sky: vi.fn(), line: vi.fn() },
    currentStencilSource: undefined as string | undefined,
    _tileClippingMaskIDs: {} as Record<string, number>,
    drawn,
    _renderTileClippingMasks(layer: ReturnType<typeof layerOf>, tiles: { key: string }[] | undefined) {
      if (one.currentStencilSource === layer.source || !layer.isTileClipped() || !tiles?.length) return;
      one.currentStencilSource = layer.source;
      one._tileClippingMaskIDs = Object.fromEntries(tiles.map(({ key }) => [key, next++]));
      drawn.push(layer.source);
    },
  };
  sparePainter(one as never);
  return one as unknown as typeof one & { _renderTileClippingMasks(layer: unknown, tiles: unknown, isTexture: boolean): void };
}

const layerOf = (source: string, isClipped = true) => ({ source, isTileClipped: () => isClipped });
const tiles = (...keys: string[]) => keys.map((key) => ({ key }));

describe('drawing that nobody sees', () => {
  it('is spared where layers of several sources have the same tiles', () => {
    const one = painter();
    for (const source of ['slots', 'walls', 'areas']) one._renderTileClippingMasks(layerOf(source), tiles('a', 'b'), false);
    expect(one.drawn).toEqual(['slots']);
    expect(one.currentStencilSource).toBe('areas');
  });

  it('is done where the tiles are others', () => {
    const one = painter();
    one._renderTileClippingMasks(layerOf('slots'), tiles('a', 'b'), false);
    one._renderTileClippingMasks(layerOf('walls'), tiles('a'), false);
    one._renderTileClippingMasks(layerOf('areas'), tiles('a', 'c'), false);
    one._renderTileClippingMasks(layerOf('trails'), tiles('c'), false);
    expect(one.drawn).toEqual(['slots', 'walls', 'areas', 'trails']);
  });

  it('is done again after something has drawn over the masks', () => {
    const one = painter();
    one._renderTileClippingMasks(layerOf('slots'), tiles('a'), false);
    one.currentStencilSource = undefined;
    one._renderTileClippingMasks(layerOf('walls'), tiles('a'), false);
    expect(one.drawn).toEqual(['slots', 'walls']);
  });

  it('leaves alone what has no masks, and what is drawn for a texture', () => {
    const one = painter();
    one._renderTileClippingMasks(layerOf('slots'), tiles('a'), false);
    one._renderTileClippingMasks(layerOf('pictures', false), tiles('a'), false);
    expect(one.currentStencilSource).toBe('slots');
    one._renderTileClippingMasks(layerOf('walls'), tiles('a'), true);
    expect(one.drawn).toEqual(['slots', 'walls']);
  });

  it('is that of a sky above a map that is seen from above', () => {
    const one = painter();
    const before = one.drawFunctions.line;
    one.drawFunctions.sky();
    expect(one.drawFunctions.line).toBe(before);
    expect(vi.isMockFunction(one.drawFunctions.sky)).toBe(false);
  });
});
