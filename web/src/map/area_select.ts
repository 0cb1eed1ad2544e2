import type { Map as MapLibreMap } from 'maplibre-gl';
import type { LonLat } from './geometry';

/** A shorter drag is a click. */
const LEAST_PX = 6;

export interface AreaEvents {
  /** A free line is drawn rather than a rectangle, without any key. */
  isLasso(): boolean;
  /** The outline on the screen that was drawn; `adds` to what was selected before. */
  chosen(outline: LonLat[], adds: boolean): void;
}

/** Shift and a drag draw a rectangle over the map, the lasso a free line: what lies within is selected. Gives back how to end it. */
export function selectAreas(map: MapLibreMap, events: AreaEvents): () => void {
  const container = map.getCanvasContainer();
  const overlay = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const outline = document.createElementNS('http://www.w3.org/2000/svg', 'polygon');
  overlay.setAttribute('class', 'area');
  overlay.setAttribute('aria-hidden', 'true');
  overlay.append(outline);
  let drag: { pointer: number; points: LonLat[]; isLasso: boolean } | undefined;

  const placeOf = (event: PointerEvent): LonLat => {
    const { left, top } = container.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const shapeOf = ({ points, isLasso }: NonNullable<typeof drag>): LonLat[] => {
    const [[left, top], [right, bottom]] = [points[0]!, points.at(-1)!];
    return isLasso ? points : [[left, top], [right, top], [right, bottom], [left, bottom]]; // prettier-ignore
  };

  function down(event: PointerEvent): void {
    const isLasso = events.isLasso();
    if (event.button !== 0 || drag || !(isLasso || event.shiftKey)) return;
    drag = { pointer: event.pointerId, points: [placeOf(event)], isLasso };
    map.dragPan.disable();
    addEventListener('pointermove', move);
    addEventListener('pointerup', up);
    addEventListener('pointercancel', end);
  }

  function move(event: PointerEvent): void {
    if (!drag || event.pointerId !== drag.pointer) return;
    drag.points.push(placeOf(event));
    if (!isDrag()) return;
    if (!overlay.isConnected) container.append(overlay);
    outline.setAttribute('points', shapeOf(drag).join(' '));
  }

  function isDrag(): boolean {
    const [x, y] = drag!.points[0]!;
    return drag!.points.some((point) => Math.hypot(point[0] - x, point[1] - y) > LEAST_PX);
  }

  function up(event: PointerEvent): void {
    if (!drag || event.pointerId !== drag.pointer) return;
    if (isDrag()) events.chosen(shapeOf(drag), event.ctrlKey || event.metaKey || (drag.isLasso && event.shiftKey));
    end();
  }

  function end(): void {
    drag = undefined;
    overlay.remove();
    map.dragPan.enable();
    removeEventListener('pointermove', move);
    removeEventListener('pointerup', up);
    removeEventListener('pointercancel', end);
  }

  container.addEventListener('pointerdown', down);
  return () => {
    container.removeEventListener('pointerdown', down);
    end();
  };
}
