import type { Family } from '../lib/protocol';

/** Outlines in a 32 x 32 box, nose up. Each family is told by its shape alone, at map size and in grey. */
const COPTER =
  'M16 3l3.2 7.2 3-3a4.6 4.6 0 1 1 3 3l-4.4 4.4v2.8l4.4 4.4a4.6 4.6 0 1 1-3 3L18 20.6h-4l-4.2 4.2a4.6 4.6 0 1 1-3-3l4.4-4.4v-2.8L6.8 10.2a4.6 4.6 0 1 1 3-3l3 3z';
const PLANE =
  'M16 2c1.3 0 2 1.6 2 3.6V12l11 6v3l-11-3v6l3.6 2.8V29L16 27.4 10.400 29v-2.200L14 24v-6L3 21v-3l11-6V5.600C14 3.600 14.700 2 16 2z';
const ROVER =
  'M16 2l5 5v2.500h2V6h5v9h-5v-3h-2v9h2v-3h5v9h-5v-3.500h-2V27a2 2 0 0 1-2 2h-6a2 2 0 0 1-2-2v-3.500H9V27H4v-9h5v3h2v-9H9v3H4V6h5v3.500h2V7z';
const BOAT = 'M16 2c4.500 4.500 7 9.500 7 15 0 4.500-1.300 8.500-3 12h-8c-1.700-3.500-3-7.500-3-12 0-5.500 2.500-10.500 7-15z';
const SUB = 'M16 3c3.300 0 5 4 5 10v3h3.500v4H21v4l2.500 4h-15l2.500-4v-4H7.500v-4H11v-3c0-6 1.700-10 5-10z';
const ROBOT = 'M16 3l3.500 5.500a10.500 10.500 0 1 1-7 0zM16 13a5.500 5.500 0 1 0 0 11 5.500 5.500 0 0 0 0-11z';
const ARROW = 'M16 3l10 25-10-6-10 6z';

export const SHAPES: Record<Family, string> = {
  copter: COPTER,
  plane: PLANE,
  vtol: PLANE,
  rover: ROVER,
  boat: BOAT,
  sub: SUB,
  robot: ROBOT,
  unknown: ARROW,
};

export const FAMILY_WORDS: Record<Family, string> = {
  copter: 'copter',
  plane: 'plane',
  vtol: 'VTOL',
  rover: 'rover',
  boat: 'boat',
  sub: 'submarine',
  robot: 'robot',
  unknown: 'vehicle',
};

/** For trails and plans, told apart in either theme and by the colour-blind (after Okabe and Ito). The order of ids decides. */
export const PALETTE = ['#56b4e9', '#e69f00', '#2dbd93', '#cc79a7', '#f0e442', '#d55e00', '#8f9bff', '#9ad14b'];
const PALETTE_ON_LIGHT = ['#0072b2', '#b36b00', '#00795a', '#a84b80', '#7a6c00', '#b34700', '#4a55c8', '#4d7c0f'];

export function identityColour(index: number, isDark: boolean): string {
  const palette = isDark ? PALETTE : PALETTE_ON_LIGHT;
  return palette[index % palette.length]!;
}
