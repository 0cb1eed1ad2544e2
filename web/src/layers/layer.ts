import type { GeoJSONSource, GeoJSONSourceSpecification, LayerSpecification, Map as MapLibreMap } from 'maplibre-gl';
import type { Bounds, LonLat } from '../map/geometry';
import type { MapColours } from '../map/colours';
import type { Paper } from '../map/overlay';
import type { Position } from '../lib/protocol';
import type { StoresToRead } from '../stores/stores';

/** How something looks on the map, in words for Help and for the list of layers. */
export interface Legend {
  sign: 'line' | 'dashes' | 'dot' | 'ring' | 'letter' | 'shape' | 'flag' | 'grid' | 'area';
  text: string;
}

/** Under which heads the list of layers has them, the topmost first. Tools are not listed: they come and go with their button. */
export const GROUPS = ['Vehicles', 'Paths', 'Found', 'Ground'] as const;
export type Group = (typeof GROUPS)[number] | 'Tools';

/** What a layer draws on, and what it must know of the page besides the stores. */
export interface Drawing {
  readonly map: MapLibreMap;
  /** Grows when the map has got a new style: its sources are empty then. */
  readonly generation: number;
  /** What is in sight, once the map has come to rest. */
  readonly view: Bounds;
  /** Of the map at rest, in steps of a half. */
  readonly zoom: number;
  readonly selected: readonly string[];
  /** The places that the measure goes along. */
  readonly measured: readonly Position[];
  /** The colour by which a vehicle's paths are told apart. */
  readonly colourOf: (vehicle: string) => string;
  readonly source: (id: string) => GeoJSONSource | undefined;
  /** What the layer paints has changed. */
  readonly wantsPaint: () => void;
  /**
   * Gives sources what has changed, as often as this machine can draw it; of what has to wait the newest by that name is done. `isMuch`
   * where one message has brought so much that more of it is on its way.
   */
  readonly paced: (name: string, work: () => void, isMuch?: boolean) => void;
}

/** What lies at a place on the screen. */
export interface Hit {
  vehicles: readonly string[];
  /** Something that was found, where no vehicle is meant. */
  feature?: { layer: string; id: string };
  at: LonLat;
  /** From the place, in px. */
  distance: number;
}

/** One kind of thing on the map. It keeps what it has drawn, so each map has layers of its own. */
export interface MapLayer {
  readonly id: string;
  /** In the list of layers. */
  readonly name: string;
  readonly group: Group;
  readonly legend: readonly Legend[];
  readonly sources: Readonly<Record<string, GeoJSONSourceSpecification>>;
  /** How the sources look, the lowest first. Opacities must not depend on the zoom: they are multiplied by the operator's. */
  layers(colours: MapColours, hasTiles: boolean): LayerSpecification[];
  /** Draws what the stores tell now. It is called again whenever anything that it read of them, or of the drawing, has changed. */
  update(drawing: Drawing): void;
  /** Draws what moves, on the sheet above the map; whether it moves on by itself, and wants the next frame, too. */
  paint?(paper: Paper, now: number): boolean;
  /** Takes away what it has beside its sources, while the operator does not want to see it. */
  hide?(): void;
  /** What of it lies nearest to a place on the screen, not further away than so many px. */
  hit?(place: { x: number; y: number }, within: number, drawing: Drawing): Hit | undefined;
}

export type MakeLayer = (stores: StoresToRead) => MapLayer;

/** A source that has nothing until its layer gives it something. */
export const EMPTY: GeoJSONSourceSpecification = { type: 'geojson', data: { type: 'FeatureCollection', features: [] } };

/** What a vehicle's things on the map are coloured by. */
export const COLOUR = ['get', 'colour'] as unknown as string;

/** Of a text on the map: drawn with the browser's own fonts. The first name of the bold ones gives the weight; no font is called so. */
export const FONT = ['system-ui', 'sans-serif'];
export const BOLD = ['Semibold', ...FONT];
