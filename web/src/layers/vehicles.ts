import type { Vehicle } from '../lib/fleet';
import { metres } from '../lib/format';
import { rowsWithoutOverlap } from '../map/geometry';
import { isOld, statusOf } from '../lib/status';
import { VehicleMarker } from '../map/marker';
import { lonLat, removeMissing } from './features';
import type { Drawing, MakeLayer } from './layer';

/** The vehicles, each a button, so that keyboards and screen readers reach them, too. */
export const vehicles: MakeLayer = ({ fleet, session }) => {
  const markers = new Map<string, VehicleMarker>();
  const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');
  let isPicking = false;

  function show({ id, fields, heardAt }: Vehicle, { map, colourOf, selected, select }: Drawing): void {
    if (!fields.position) return;
    const marker = markers.get(id) ?? new VehicleMarker(map, (adds) => select(id, adds), () => isPicking); // prettier-ignore
    markers.set(id, marker);
    const vehicle = { id, fields, heardAt };
    marker.show(
      {
        at: lonLat(fields.position),
        headingRad: fields.heading_rad,
        family: fields.family ?? 'unknown',
        name: fields.name || id,
        detail: detailOf(vehicle),
        status: statusOf(vehicle, session.isLost, fleet.batteryLimits),
        colour: colourOf(id),
        isSelected: selected.includes(id),
      },
      !reducedMotion.matches,
    );
  }

  return {
    id: 'vehicles',
    legend: [{ sign: 'shape', text: 'a vehicle, its shape that of its family, turned to where it heads; its colour is its state' }],
    sources: {},
    layers: () => [],
    update(drawing) {
      isPicking = drawing.isPicking;
      for (const vehicle of fleet.vehicles.values()) show(vehicle, drawing);
      removeMissing(markers, (id) => fleet.vehicles.has(id));
      spreadLabels([...markers.values()], drawing);
    },
    moved: (drawing) => spreadLabels([...markers.values()], drawing),
  };
};

function detailOf(vehicle: Vehicle): string {
  const { mode, relative_alt_m: height } = vehicle.fields;
  const isHigh = height !== undefined && Math.abs(height) > 0.5;
  return [isOld(vehicle) && 'last known', mode, isHigh && metres(height)].filter(Boolean).join(' · ');
}

/** Vehicles that stand side by side have their labels one below the other. */
function spreadLabels(markers: VehicleMarker[], { map }: Drawing): void {
  const boxes = markers.map((marker) => {
    const { x, y } = map.project(marker.place());
    const { width, height } = marker.labelSize();
    return { left: x - width / 2, top: y, width, height };
  });
  rowsWithoutOverlap(boxes).forEach((rows, index) => markers[index]!.lowerLabel(rows));
}
