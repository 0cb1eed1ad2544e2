import { foundLayer } from './found_layer';

/** Which ground the pictures show that are kept. */
export const footprints = foundLayer({
  id: 'pictures',
  name: 'Pictures',
  legend: [{ sign: 'ring', text: 'the ground that a picture shows: click it to see the picture' }],
  looks: ({ accent, panel }) =>
    [
      {
        id: 'footprints-fill',
        type: 'fill',
        filter: ['==', ['geometry-type'], 'Polygon'],
        // To be clicked, and not drawn: pictures lie on each other in dozens, and each tint would cover the map once more.
        paint: { 'fill-antialias': false, 'fill-opacity': 0 },
      },
      {
        id: 'footprints-line',
        type: 'line',
        filter: ['==', ['geometry-type'], 'Polygon'],
        paint: { 'line-color': accent, 'line-width': 1, 'line-opacity': 0.5 },
      },
      {
        id: 'footprints-dot',
        type: 'circle',
        filter: ['==', ['geometry-type'], 'Point'],
        paint: { 'circle-radius': 3.5, 'circle-color': panel, 'circle-stroke-color': accent, 'circle-stroke-width': 1.6 },
      },
    ] as never,
});
