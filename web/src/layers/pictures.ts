import { addPictures } from '../lib/fleet';
import type { Frame } from '../connection/frame';
import type { Picture } from '../lib/protocol';
import { featuresOf, lonLat } from './features';
import { COLOUR, EMPTY, type MakeLayer } from './layer';

type Pictures = Map<string, Picture[]>;

function withMore(pictures: Pictures, { message }: Frame): Pictures {
  if (message?.type !== 'pictures') return pictures;
  return addPictures(pictures, message.vehicle, message.pictures, message.full);
}

/** Where cameras have taken pictures. */
export const pictures: MakeLayer = ({ feeds }) => {
  const taken = feeds.follow<Pictures>('pictures', new Map(), withMore);
  return {
    id: 'pictures',
    name: 'Pictures taken',
    group: 'Found',
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
      const marks = [...taken.content].flatMap(([id, places]) => {
        const properties = { colour: colourOf(id) };
        return places.map((place) => ({ properties, point: lonLat(place) }));
      });
      source('pictures')?.setData(featuresOf(marks));
    },
  };
};
