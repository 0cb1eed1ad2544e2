import { foundLayer } from './found_layer';

/** Walls as they were fitted, cased to be seen on any ground. */
export const walls = foundLayer({
  id: 'walls',
  name: 'Walls',
  legend: [{ sign: 'line', text: 'a wall' }],
  looks: ({ panel, text }) =>
    [
      {
        id: 'walls-casing',
        type: 'line',
        layout: { 'line-cap': 'round' },
        paint: { 'line-color': panel, 'line-width': ['interpolate', ['exponential', 2], ['zoom'], 16, 3, 22, 12], 'line-opacity': 0.7 },
      },
      {
        id: 'walls-line',
        type: 'line',
        layout: { 'line-cap': 'round' },
        paint: { 'line-color': text, 'line-width': ['interpolate', ['exponential', 2], ['zoom'], 16, 1.2, 22, 8] },
      },
    ] as never,
});
