import { featuresOf, lonLat } from './features';
import { COLOUR, EMPTY, type MakeLayer } from './layer';

/** Where cameras have taken pictures. */
export const pictures: MakeLayer = ({ layers: content }) => ({
  id: 'pictures',
  legend: [{ sign: 'ring', text: 'a picture was taken here' }],
  sources: { pictures: EMPTY },
  layers: ({ ground }) => [
    {
      id: 'pictures',
      type: 'circle',
      source: 'pictures',
      minzoom: 13,
      paint: { 'circle-radius': 2.6, 'circle-color': ground, 'circle-stroke-color': COLOUR, 'circle-stroke-width': 1.4 },
    },
  ],
  update({ generation, colourOf, source }) {
    if (generation === 0) return;
    const marks = [...content.pictures].flatMap(([id, places]) => {
      const properties = { colour: colourOf(id) };
      return places.map((place) => ({ properties, point: lonLat(place) }));
    });
    source('pictures')?.setData(featuresOf(marks));
  },
});
