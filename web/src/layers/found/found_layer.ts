import type { GeoJSONSourceSpecification, LayerSpecification } from 'maplibre-gl';
import type { MapColours } from '../../map/colours';
import { EMPTY, type Hit, type Legend, type MakeLayer } from '../layer';
import { DrawnFeatures, followFeatures, type FeatureLayer } from './map_features';

/** What is to be said of a layer of features that vehicles or people have put on the map. */
interface Found {
  id: FeatureLayer;
  name: string;
  legend: readonly Legend[];
  /** Its looks; the id of each begins with the layer's, and its source is the layer's. */
  looks: (colours: MapColours) => LayerSpecification[];
}

/** One message brings no more than some hundred of a layer: where it brought so many, the rest follows. */
const MUCH = 50;

const SOURCE: GeoJSONSourceSpecification = { ...EMPTY, promoteId: 'id' };

/** Of what the station tells of a layer those on the floors that are shown. */
export function foundLayer({ id, name, legend, looks }: Found): MakeLayer {
  return ({ feeds, floors }) => {
    const features = followFeatures(feeds, id);
    const drawn = new DrawnFeatures();
    const source = `found-${id}`;
    let ids: string[] = [];
    let seen = 0;
    return {
      id: source,
      name,
      group: 'Found',
      legend,
      sources: { [source]: SOURCE },
      layers(colours) {
        const all = looks(colours).map((look) => ({ ...look, source }) as LayerSpecification);
        ids = all.map((look) => look.id);
        return all;
      },
      update(drawing) {
        const { generation } = drawing;
        const shown = new Map([...features.content].filter(([, feature]) => floors.isShown(feature)));
        if (generation === 0) return;
        const isMuch = shown.size > seen + MUCH;
        seen = shown.size;
        // A new style has asked for what it shows by then.
        const show = (): unknown => drawing.generation === generation && drawn.show(drawing.source(source), generation, shown);
        drawing.paced(source, show, isMuch);
      },
      hit({ x, y }, within, { map }): Hit | undefined {
        const reach = within / 3;
        const box: [[number, number], [number, number]] = [[x - reach, y - reach], [x + reach, y + reach]]; // prettier-ignore
        const [top] = map.queryRenderedFeatures(box, { layers: ids.filter((one) => map.getLayer(one)) });
        const feature = top && features.content.get(String(top.id));
        if (!feature) return undefined;
        const { lng, lat } = map.unproject([x, y]);
        // What lies flat is found last: vehicles stand on it.
        return { vehicles: [], feature: { layer: id, id: feature.id }, at: [lng, lat], distance: within };
      },
    };
  };
}
