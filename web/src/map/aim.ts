import { Marker, type LngLat, type Map as MapLibreMap } from 'maplibre-gl';
import type { LonLat } from './geometry';

const STEP_PX = 10;
/** With Shift: as far as an arrow key moves the map itself. */
const LONG_STEP_PX = 100;
/** Nearer to the edge of what is in sight the map moves, too. */
const MARGIN_PX = 40;
const STEPS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export interface Sides {
  top: number;
  right: number;
  bottom: number;
  left: number;
}

export interface AimEvents {
  /** What the place is for, to screen readers. */
  purpose: string;
  /** How far panels cover the map. */
  covered(): Sides;
  /** What to say of the place, beside the cross and to screen readers. */
  describe(place: LngLat): string;
  picked(place: LngLat): void;
}

/**
 * A cross for choosing a place without a pointer: arrow keys move it, and the map where it would leave the sight; Enter and Space
 * choose. It has the focus from the start; who points at the map instead does not see it.
 */
export function aimMarker(map: MapLibreMap, start: LonLat, events: AimEvents): Marker {
  const element = document.createElement('div');
  element.className = 'target aim';
  element.tabIndex = 0;
  // Screen readers are to pass the arrow keys on.
  element.setAttribute('role', 'application');
  element.setAttribute(
    'aria-label',
    `${events.purpose}. Arrow keys move it, with Shift further; plus and minus zoom; Enter chooses it, Escape leaves.`,
  );
  const label = document.createElement('span');
  label.className = 'label';
  label.setAttribute('role', 'status');
  element.append(label);
  const marker = new Marker({ element }).setLngLat(start).addTo(map);

  const moveTo = (place: LngLat): void => {
    marker.setLngLat(place);
    bringIntoSight(map, place, events.covered());
    label.textContent = events.describe(place);
  };
  element.addEventListener('keydown', (event) => {
    const step = STEPS[event.key];
    const isChoice = event.key === 'Enter' || event.key === ' ';
    if (!step && !isChoice) return;
    event.preventDefault();
    event.stopPropagation(); // or the map moves by itself
    element.classList.add('moved');
    if (step) {
      const size = event.shiftKey ? LONG_STEP_PX : STEP_PX;
      const { x, y } = map.project(marker.getLngLat());
      moveTo(map.unproject([x + step[0] * size, y + step[1] * size]));
    } else if (!event.repeat) events.picked(marker.getLngLat());
  });
  moveTo(marker.getLngLat());
  element.focus({ preventScroll: true });
  return marker;
}

function bringIntoSight(map: MapLibreMap, place: LngLat, covered: Sides): void {
  const { x, y } = map.project(place);
  const { clientWidth, clientHeight } = map.getContainer();
  const beyond = (at: number, low: number, high: number): number => Math.min(0, at - low - MARGIN_PX) + Math.max(0, at - high + MARGIN_PX);
  const by: [number, number] = [
    beyond(x, covered.left, clientWidth - covered.right),
    beyond(y, covered.top, clientHeight - covered.bottom),
  ];
  if (by[0] !== 0 || by[1] !== 0) map.panBy(by, { animate: false });
}
