/** A unit quaternion from a camera's frame (x right, y down, z ahead) to east, north, up. */
export interface Turn {
  x: number;
  y: number;
  z: number;
  w: number;
}

/** Where a camera looks. */
export interface ViewAxis {
  /** Clockwise from north, of the view, or of a picture's upper edge where the camera looks along the plumb line. */
  azimuth_deg: number;
  /** Above the horizon; -90 is straight down. */
  elevation_deg: number;
  /** It looks so nearly along the plumb line that only the upper edge has a direction. */
  isPlumb: boolean;
}

const PLUMB_DEG = 80;
const degrees = (radians: number): number => (radians * 180) / Math.PI;

/** Nothing for numbers that are no turn. */
export function viewAxis({ x, y, z, w }: Turn): ViewAxis | undefined {
  const length = Math.hypot(x, y, z, w);
  if (!(Math.abs(length - 1) < 0.01)) return undefined;
  // The third column of the rotation is the view, the second the lower edge.
  const [east, north, up] = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
  const elevation_deg = degrees(Math.asin(Math.max(-1, Math.min(1, up))));
  const isPlumb = Math.abs(elevation_deg) > PLUMB_DEG;
  const [upperEast, upperNorth] = [-2 * (x * y - w * z), -(1 - 2 * (x * x + z * z))];
  const azimuth = isPlumb ? Math.atan2(upperEast, upperNorth) : Math.atan2(east, north);
  return { azimuth_deg: (degrees(azimuth) + 360) % 360, elevation_deg, isPlumb };
}

const ROSE = ['north', 'north-east', 'east', 'south-east', 'south', 'south-west', 'west', 'north-west'] as const;

export function axisText({ azimuth_deg, elevation_deg, isPlumb }: ViewAxis): string {
  const towards = ROSE[Math.round(azimuth_deg / 45) % 8]!;
  const angle = `${String(Math.round(azimuth_deg) % 360).padStart(3, '0')}°`;
  if (isPlumb) return `straight ${elevation_deg < 0 ? 'down' : 'up'}, its upper edge ${towards} (${angle})`;
  const tilt = Math.round(elevation_deg);
  return `${towards} (${angle})${tilt === 0 ? '' : `, ${Math.abs(tilt)}° ${tilt < 0 ? 'down' : 'up'}`}`;
}
