import { conditionOf, type SurveyDrone } from '../lib/reports/survey';
import type { Paper } from '../map/overlay';
import type { MakeLayer } from './layer';

const REACH_PX = 9;
const NAME_PX = 12;

/** Where survey drones say that they are: what is heard of them by MAVLink, too, is among the vehicles. */
export const surveyDrones: MakeLayer = ({ survey }) => {
  let shown: readonly SurveyDrone[] = [];
  return {
    id: 'survey_drones',
    name: 'Survey drones',
    group: 'Vehicles',
    legend: [{ sign: 'shape', text: 'a survey drone, by its own account' }],
    sources: {},
    layers: () => [],
    update({ wantsPaint }) {
      if (survey.drones === shown) return;
      shown = survey.drones;
      wantsPaint();
    },
    paint(paper) {
      for (const drone of shown) paintDrone(paper, drone);
      return false;
    },
  };
};

/** A diamond in the colour of how it is, with its name. */
function paintDrone({ on, colours, place, taken }: Paper, drone: SurveyDrone): void {
  if (!drone.position) return;
  const { x, y } = place([drone.position.lon_deg, drone.position.lat_deg]);
  on.beginPath();
  on.moveTo(x, y - REACH_PX);
  on.lineTo(x + REACH_PX, y);
  on.lineTo(x, y + REACH_PX);
  on.lineTo(x - REACH_PX, y);
  on.closePath();
  on.fillStyle = colours.levels[conditionOf(drone).level];
  on.strokeStyle = colours.ground;
  on.lineWidth = 2;
  on.fill();
  on.stroke();
  on.font = `600 ${NAME_PX}px system-ui, sans-serif`;
  on.textBaseline = 'middle';
  on.lineWidth = 3;
  on.strokeText(drone.name, x + REACH_PX + 4, y);
  on.fillStyle = colours.levels[conditionOf(drone).level];
  on.fillText(drone.name, x + REACH_PX + 4, y);
  const { width } = on.measureText(drone.name);
  taken.push({ left: x - REACH_PX, top: y - REACH_PX, width: 2 * REACH_PX + 4 + width, height: 2 * REACH_PX });
}
