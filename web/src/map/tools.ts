/** What a click or a drag at the map is for: to select, to choose a place to go to, to measure, to find a place of a plan, to select with a free line. */
export type Tool = 'none' | 'place' | 'measure' | 'control' | 'lasso';
