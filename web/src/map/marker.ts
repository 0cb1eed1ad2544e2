import { Marker, type Map as MapLibreMap } from 'maplibre-gl';
import type { LonLat } from './geometry';

/** Where vehicles were sent, and what is left of the way. */
export class DestinationMarker {
  private readonly marker: Marker;
  private readonly label = document.createElement('span');

  constructor(map: MapLibreMap, at: LonLat) {
    const element = document.createElement('div');
    element.className = 'target sent';
    element.setAttribute('role', 'img');
    this.label.className = 'left';
    element.append(this.label);
    this.marker = new Marker({ element }).setLngLat(at).addTo(map);
  }

  show(left: string, names: string): void {
    this.label.textContent = left;
    this.marker.getElement().setAttribute('aria-label', `destination of ${names}${left ? `, ${left}` : ''}`);
  }

  remove(): void {
    this.marker.remove();
  }
}

/** Where vehicles are about to be sent. */
export function targetMarker(map: MapLibreMap, at: LonLat): Marker {
  const element = document.createElement('div');
  element.className = 'target';
  element.setAttribute('role', 'img');
  element.setAttribute('aria-label', 'the chosen place');
  return new Marker({ element }).setLngLat(at).addTo(map);
}
