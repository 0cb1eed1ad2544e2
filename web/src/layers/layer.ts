import type { GeoJSONSource, GeoJSONSourceSpecification, LayerSpecification, Map as MapLibreMap } from 'maplibre-gl';
import type { Bounds } from '../map/geometry';
import type { MapColours } from '../map/colours';
import type { StoresToRead } from '../stores/stores';

/** How something looks on the map, in words for Help. */
export interface Legend {
  sign: 'line' | 'dashes' | 'dot' | 'ring' | 'letter' | 'shape';
  text: string;
}

/** What a layer draws on, and what it must know of the page besides the stores. */
export interface Drawing {
  readonly map: MapLibreMap;
  /** Grows when the map has got a new style: its sources are empty then. */
  readonly generation: number;
  /** What is in sight, once the map has come to rest. */
  readonly view: Bounds;
  readonly selected: readonly string[];
  /** Whether the next click chooses a place, not a vehicle. */
  readonly isPicking: boolean;
  /** The colour by which a vehicle's paths are told apart. */
  readonly colourOf: (vehicle: string) => string;
  readonly select: (vehicle: string, adds: boolean) => void;
  readonly source: (id: string) => GeoJSONSource | undefined;
}

/** One kind of thing on the map. It keeps what it has drawn, so each map has layers of its own. */
export interface MapLayer {
  readonly id: string;
  readonly legend: readonly Legend[];
  readonly sources: Readonly<Record<string, GeoJSONSourceSpecification>>;
  /** How the sources look, the lowest first. */
  layers(colours: MapColours, hasTiles: boolean): LayerSpecification[];
  /** Draws what the stores tell now. It is called again whenever anything that it read of them, or of the drawing, has changed. */
  update(drawing: Drawing): void;
  /** The map moves: what lies beside it on the screen follows. */
  moved?(drawing: Drawing): void;
}

export type MakeLayer = (stores: StoresToRead) => MapLayer;

/** A source that has nothing until its layer gives it something. */
export const EMPTY: GeoJSONSourceSpecification = { type: 'geojson', data: { type: 'FeatureCollection', features: [] } };

/** What a vehicle's things on the map are coloured by. */
export const COLOUR = ['get', 'colour'] as unknown as string;
