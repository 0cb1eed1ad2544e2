import { describe, expect, it, vi } from 'vitest';
import { gatherPictures, sparePainter } from './spared_drawing';

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

describe('pictures of what comes bit by bit', () => {
  /** A map one of whose sources has tiles on their way; its time goes by when it is told. */
  function map(isSlow = true) {
    const listeners = new Map<string, () => void>();
    const waiting: (() => void)[] = [];
    const one = {
      pictures: 0,
      moves: false,
      missing: true,
      triggerRepaint: () => void (one.pictures += 1),
      isMoving: () => one.moves,
      on: (event: string, listener: () => void) => listeners.set(event, listener),
      style: { tileManagers: { slots: { loaded: () => !one.missing }, walls: { loaded: () => true } } },
      tell: (event: string) => listeners.get(event)?.(),
      look: (times = 1) => {
        for (let i = 0; i < times; ++i) for (const work of waiting.splice(0)) work();
      },
    };
    gatherPictures(
      one,
      () => isSlow,
      (work) => waiting.push(work),
    );
    return one;
  }

  it('are one when all of it is there', () => {
    const one = map();
    for (let tile = 0; tile < 6; ++tile) one.triggerRepaint();
    one.look(5);
    expect(one.pictures).toBe(0);
    one.missing = false;
    one.look();
    expect(one.pictures).toBe(1);
    one.look(100);
    one.triggerRepaint();
    expect(one.pictures).toBe(2);
  });

  it('do not wait for ever', () => {
    const one = map();
    one.triggerRepaint();
    one.look(100);
    expect(one.pictures).toBe(1);
  });

  it('wait for nothing where they are quick', () => {
    const one = map(false);
    one.triggerRepaint();
    expect(one.pictures).toBe(1);
  });

  it('wait for nothing while the map moves', () => {
    const one = map();
    one.triggerRepaint();
    one.tell('move');
    expect(one.pictures).toBe(1);
    one.moves = true;
    one.triggerRepaint();
    expect(one.pictures).toBe(2);
  });
});
