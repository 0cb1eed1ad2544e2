import { Marker, type Map as MapLibreMap } from 'maplibre-gl';
import type { LonLat } from './geometry';
import type { Family } from '../lib/protocol';
import { FAMILY_WORDS, SHAPES } from './shapes';
import type { Status } from '../lib/status';

export interface MarkerState {
  at: LonLat;
  headingRad: number | undefined;
  family: Family;
  name: string;
  detail: string;
  status: Status;
  colour: string;
  isSelected: boolean;
}

const SVG = 'http://www.w3.org/2000/svg';
const GLIDE_MS = 220; // a little longer than the pause between two messages, so that motion does not stutter

/** A vehicle on the map: shape of its family turned to its heading, a badge for its status, a label. A button for the keyboard. */
export class VehicleMarker {
  private readonly marker: Marker;
  private readonly button = document.createElement('button');
  private readonly shape = document.createElementNS(SVG, 'path');
  private readonly svg = document.createElementNS(SVG, 'svg');
  private readonly badge = document.createElement('span');
  private readonly label = document.createElement('span');
  private readonly detail = document.createElement('span');
  private readonly labelName = document.createElement('span');
  private family: Family | undefined;
  /** What it was last told to look like. */
  private look = '';
  private isSelected = false;
  private size: { width: number; height: number; window: number } | undefined;
  private margin = '';
  private from: LonLat | undefined;
  private to: LonLat | undefined;
  private glideStart = 0;
  private frame = 0;

  constructor(
    private readonly map: MapLibreMap,
    onSelect: (adds: boolean) => void,
    /** Whether to click at it is to click at the map below, where a place is chosen. */
    isGlass: () => boolean,
  ) {
    this.button.type = 'button';
    this.svg.setAttribute('viewBox', '-2 -2 36 36');
    this.svg.setAttribute('aria-hidden', 'true');
    this.svg.append(this.shape);
    this.badge.className = 'badge';
    this.label.className = 'label';
    this.detail.className = 'detail';
    this.label.append(this.labelName, this.detail);
    this.button.append(this.svg, this.badge, this.label);
    this.button.addEventListener('click', (event) => {
      if (isGlass() && event.detail > 0) return; // no key's
      event.stopPropagation();
      onSelect(event.shiftKey || event.ctrlKey || event.metaKey);
    });
    this.marker = new Marker({ element: this.button });
  }

  show(state: MarkerState, glides: boolean): void {
    const look = JSON.stringify({ ...state, at: undefined });
    // To write the same again would cost the page a new layout.
    if (look !== this.look) this.dress(state);
    this.look = look;
    this.moveTo(state.at, glides);
  }

  private dress(state: MarkerState): void {
    this.button.className = `vehicle ${state.status.level} ${state.isSelected ? 'selected' : ''} maplibregl-marker`;
    this.button.setAttribute('aria-label', `${state.name}, ${FAMILY_WORDS[state.family]}, ${state.status.word}`);
    this.button.setAttribute('aria-pressed', String(state.isSelected));
    this.button.style.setProperty('--identity', state.colour);
    if (this.family !== state.family) this.shape.setAttribute('d', SHAPES[(this.family = state.family)]);
    this.svg.style.transform = `rotate(${state.headingRad ?? 0}rad)`;
    const badge = state.status.level === 'active' || state.status.level === 'ready' ? '' : state.status.symbol;
    if (this.badge.textContent !== badge) this.badge.textContent = badge;
    const hasNewWords = this.labelName.textContent !== state.name || this.detail.textContent !== state.detail;
    if (!hasNewWords && this.isSelected === state.isSelected) return;
    this.isSelected = state.isSelected; // on a phone it has a longer label
    this.labelName.textContent = state.name;
    this.detail.textContent = state.detail;
    this.size = undefined;
  }

  /** Where it stands, or glides to; nothing before it was shown. */
  place(): LonLat {
    return this.to ?? this.shown();
  }

  /** Size of the label on the screen in px. */
  labelSize(): { width: number; height: number } {
    const window = this.map.getCanvas().width; // a narrow one has shorter labels
    if (this.size?.window !== window) this.size = { width: this.label.offsetWidth, height: this.label.offsetHeight, window };
    return this.size;
  }

  /** Moves the label down by so many of its heights, where another vehicle's would cover it. */
  lowerLabel(rows: number): void {
    const margin = rows > 0 ? `${rows * this.labelSize().height}px` : '';
    if (margin !== this.margin) this.label.style.marginTop = this.margin = margin;
  }

  remove(): void {
    cancelAnimationFrame(this.frame);
    this.marker.remove();
  }

  private moveTo(at: LonLat, glides: boolean): void {
    const isFirst = !this.to;
    if (!isFirst && this.to![0] === at[0] && this.to![1] === at[1]) return;
    cancelAnimationFrame(this.frame);
    this.from = isFirst || !glides ? at : this.shown();
    this.to = at;
    this.glideStart = performance.now();
    this.marker.setLngLat(this.from);
    if (isFirst) this.marker.addTo(this.map);
    if (this.from !== at) this.frame = requestAnimationFrame(() => this.glide());
  }

  private glide(): void {
    const share = Math.min(1, (performance.now() - this.glideStart) / GLIDE_MS);
    const [from, to] = [this.from!, this.to!];
    this.marker.setLngLat([from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]);
    if (share < 1) this.frame = requestAnimationFrame(() => this.glide());
  }

  private shown(): LonLat {
    const { lng, lat } = this.marker.getLngLat();
    return [lng, lat];
  }
}

/** The place a vehicle returns to. */
export function homeMarker(map: MapLibreMap, at: LonLat): Marker {
  const element = document.createElement('div');
  element.className = 'home';
  element.setAttribute('role', 'img');
  element.setAttribute('aria-label', 'home');
  element.textContent = 'H';
  return new Marker({ element }).setLngLat(at).addTo(map);
}

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
