import type { Legend, MakeLayer, MapLayer } from './layer';
import type { StoresToRead } from '../stores/stores';
import { areas } from './found/areas';
import { floorPlans } from './found/floor_plans';
import { footprints } from './found/footprints';
import { grids } from './found/grids';
import { pointsOfInterest } from './found/points_of_interest';
import { slots } from './found/slots';
import { walls } from './found/walls';
import { changes } from './changes';
import { destinations } from './destinations';
import { grid } from './grid';
import { homes } from './homes';
import { intents } from './intents';
import { measure } from './measure';
import { pictures } from './pictures';
import { plans } from './plans';
import { robots } from './robots';
import { surveyDrones } from './survey_drones';
import { trails } from './trails';
import { vehicles } from './vehicles';

/** Everything that the map shows, the lowest first. Whoever adds a kind of thing writes its file and names it here. */
const LAYERS: readonly MakeLayer[] = [
  grid,
  floorPlans,
  grids,
  areas,
  slots,
  footprints,
  walls,
  plans,
  trails,
  pictures,
  destinations,
  intents,
  homes,
  robots,
  pointsOfInterest,
  changes,
  surveyDrones,
  vehicles,
  measure,
];

export function makeLayers(stores: StoresToRead): MapLayer[] {
  return LAYERS.map((make) => make(stores));
}

export function legendsOf(layers: readonly MapLayer[]): Legend[] {
  return layers.flatMap(({ legend }) => legend);
}
