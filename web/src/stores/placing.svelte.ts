import type { MapFeature } from '../layers/found/map_features';
import { bodyOf } from '../lib/files/answers';
import { thumbnailOf, type ChosenPicture } from '../lib/files/picture_file';
import { controlPoints, Ground, pictureCorners, type Pair } from '../lib/places/ground';
import { place, type Method, type Placement } from '../lib/places/placement';
import type { Session } from './session.svelte';

type LonLat = [number, number];

/** Pictures that people lay on the ground by a few places that they find in both. */
export class PlacingStore {
  /** Nothing while none is being placed. */
  picture = $state.raw<ChosenPicture | undefined>();
  pairs = $state.raw<readonly Pair[]>([]);
  /** Chosen in the picture; its place on the map is still to be chosen. */
  waiting = $state.raw<{ u: number; v: number } | undefined>();
  method = $state<Method>('similarity');
  site = $state('');
  floor = $state('');
  /** Of the one that lies there already; empty for a new one. */
  id = $state('');
  failure = $state('');
  isSaving = $state(false);
  /** Grows with each picture that is begun, so that nobody takes one for another. */
  round = $state(0);
  private image = '';
  private thumbnail = '';
  private takenAt = '';

  constructor(private readonly session: Session) {}

  /** Where the picture lies by the pairs, or what is missing for that. */
  readonly placed = $derived.by<Placement | string>(() => {
    const ground = this.ground;
    return ground ? place(controlPoints(ground, this.pairs), this.method) : 'Choose a place in the picture.';
  });

  /** Of the picture on the map, from its upper left one clockwise. */
  readonly corners = $derived.by<LonLat[] | undefined>(() => {
    const { placed, ground, picture } = this;
    if (typeof placed === 'string' || !ground || !picture) return undefined;
    return ground.corners(placed.affine, picture.width, picture.height);
  });

  begin(picture: ChosenPicture, site: string, floor: string): void {
    this.clear();
    [this.picture, this.site, this.floor] = [picture, site, floor];
    this.round += 1;
  }

  /** One that lies there: by three of its corners, which are as good as any places. */
  async adjust(feature: MapFeature): Promise<void> {
    const { image, thumbnail, taken_at, media_type, width_px, height_px, site, floor } = feature.properties;
    const ring = feature.geometry.type === 'Polygon' ? feature.geometry.coordinates[0] : undefined;
    const corners = ring && pictureCorners(ring);
    const answer = await this.session.ask(`/api/v1/blobs/${String(image)}`);
    const bytes = answer?.ok ? await answer.blob() : undefined;
    this.clear();
    const isJpeg = media_type === 'image/jpeg';
    if (!bytes || !corners || !(isJpeg || media_type === 'image/png')) {
      this.failure = 'The station does not give this picture.';
      return;
    }
    const [width, height] = [Number(width_px), Number(height_px)];
    this.picture = { name: feature.id, bytes, media_type: isJpeg ? 'image/jpeg' : 'image/png', width, height };
    const at = (corner: 0 | 1 | 2): Pair['at'] => ({ lon_deg: corners[corner][0], lat_deg: corners[corner][1] });
    this.pairs = [{ u: 0, v: 0, at: at(0) }, { u: width, v: 0, at: at(1) }, { u: width, v: height, at: at(2) }]; // prettier-ignore
    this.method = typeof this.placed !== 'string' && this.placed.residual_m < 0.01 ? 'similarity' : 'affine';
    [this.id, this.site, this.floor] = [feature.id, String(site), typeof floor === 'string' ? floor : ''];
    [this.image, this.thumbnail, this.takenAt] = [String(image), typeof thumbnail === 'string' ? thumbnail : '', String(taken_at)];
    this.round += 1;
  }

  choose(u: number, v: number): void {
    this.waiting = { u, v };
  }

  /** Where the place lies that was chosen in the picture. */
  meet(at: Pair['at']): void {
    if (this.waiting) this.pairs = [...this.pairs, { ...this.waiting, at }];
    this.waiting = undefined;
  }

  /** Nobody seeks the place on the map any more. */
  leave(): void {
    this.waiting = undefined;
  }

  setMethod(method: Method): void {
    this.method = method;
  }

  lieIn(site: string, floor: string): void {
    [this.site, this.floor] = [site, floor];
  }

  remove(index: number): void {
    this.pairs = this.pairs.filter((_, at) => at !== index);
  }

  cancel(): void {
    this.clear();
  }

  /** Whether it lies on the map now. */
  async save(): Promise<boolean> {
    if (!this.corners || this.isSaving) return false;
    this.isSaving = true;
    this.failure = await this.put();
    this.isSaving = false;
    if (this.failure) return false;
    this.clear();
    return true;
  }

  /** Takes one off the map. */
  async takeAway(id: string): Promise<void> {
    const answer = await this.session.ask(addressOf(id), { method: 'DELETE' });
    this.failure = answer?.ok ? '' : (await bodyOf(answer)).failure;
  }

  private get ground(): Ground | undefined {
    const [first] = this.pairs;
    return first && new Ground(first.at);
  }

  /** Why it is not on the map; empty when it is. */
  private async put(): Promise<string> {
    const { picture, corners } = this;
    if (!picture || !corners) return '';
    if (!this.image) {
      const kept = await this.keep(picture.bytes);
      if (kept.failure) return kept.failure;
      this.image = kept.hash;
      const small = await thumbnailOf(picture);
      this.thumbnail = small ? (await this.keep(small)).hash : '';
    }
    const feature = {
      type: 'Feature',
      geometry: { type: 'Polygon', coordinates: [[...corners, corners[0]]] },
      properties: {
        site: this.site,
        floor: this.floor,
        image: this.image,
        ...(this.thumbnail && { thumbnail: this.thumbnail }),
        taken_at: this.takenAt || new Date().toISOString(),
        media_type: picture.media_type,
        width_px: picture.width,
        height_px: picture.height,
      },
    };
    const id = this.id || `${picture.name.replace(/\.\w+$/, '').slice(0, 60) || 'plan'} ${this.image.slice(0, 6)}`;
    const writer = encodeURIComponent(this.session.operator || 'a viewer');
    const headers = { 'Content-Type': 'application/geo+json' };
    const init = { method: 'PUT', headers, body: JSON.stringify(feature) };
    return (await bodyOf(await this.session.ask(`${addressOf(id)}?writer=${writer}`, init))).failure;
  }

  private async keep(bytes: Blob): Promise<{ hash: string; failure: string }> {
    const headers = { 'Content-Type': bytes.type };
    const { body, failure } = await bodyOf(await this.session.ask('/api/v1/blobs', { method: 'POST', headers, body: bytes }));
    return { hash: typeof body.sha256 === 'string' ? body.sha256 : '', failure };
  }

  private clear(): void {
    this.picture = this.waiting = undefined;
    this.pairs = [];
    [this.method, this.id, this.failure, this.image, this.thumbnail, this.takenAt] = ['similarity', '', '', '', '', ''];
  }
}

const addressOf = (id: string): string => `/api/v1/layers/pictures/features/${encodeURIComponent(id)}`;

/** A picture that no vehicle took, and of which somebody has said what ground it shows: a floor plan, an aerial picture. */
export function isPlan({ geometry, properties }: MapFeature): boolean {
  return geometry.type === 'Polygon' && !properties.vehicle && properties.camera_qw === undefined && typeof properties.image === 'string';
}
