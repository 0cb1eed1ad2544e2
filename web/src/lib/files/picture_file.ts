/** A picture that somebody has chosen on his computer. */
export interface ChosenPicture {
  name: string;
  bytes: Blob;
  media_type: 'image/png' | 'image/jpeg';
  width: number;
  height: number;
}

export const MOST_BYTES = 32 * 1024 * 1024;
/** Of a side: what every machine's graphics take. */
export const MOST_PX = 8192;
const THUMBNAIL_PX = 256;

/** What a picture is and how large, as its first bytes say; nothing for what is neither PNG nor JPEG. */
export function sizeOf(bytes: Uint8Array): Pick<ChosenPicture, 'media_type' | 'width' | 'height'> | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length >= 24 && view.getUint32(0) === 0x89504e47)
    return { media_type: 'image/png', width: view.getUint32(16), height: view.getUint32(20) };
  if (bytes.length < 4 || view.getUint16(0) !== 0xffd8) return undefined;
  for (let at = 2; at + 9 <= bytes.length;) {
    if (bytes[at] !== 0xff) return undefined;
    const marker = bytes[at + 1]!;
    // The frame's own segment, of whatever coding; tables and arithmetic conditioning look alike.
    const isFrame = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
    if (isFrame) return { media_type: 'image/jpeg', height: view.getUint16(at + 5), width: view.getUint16(at + 7) };
    at += marker === 0xff ? 1 : 2 + view.getUint16(at + 2);
  }
  return undefined;
}

/** The picture in a file, or in words for people why there is none. */
export async function readPicture(file: File): Promise<ChosenPicture | string> {
  if (file.size > MOST_BYTES) return `${file.name} has ${Math.round(file.size / 1e6)} MB; at most 32 MiB are taken.`;
  const size = sizeOf(new Uint8Array(await file.arrayBuffer()));
  if (!size || size.width === 0 || size.height === 0) return `${file.name} is neither a PNG nor a JPEG picture.`;
  const { width, height } = size;
  if (width > MOST_PX || height > MOST_PX) return `${file.name} has ${width} x ${height} px; at most ${MOST_PX} a side can be drawn.`;
  return { name: file.name, bytes: new Blob([file], { type: size.media_type }), ...size };
}

/** A small JPEG of it; nothing where the browser cannot make one. */
export async function thumbnailOf({ bytes, width, height }: ChosenPicture): Promise<Blob | undefined> {
  const scale = Math.min(1, THUMBNAIL_PX / Math.max(width, height));
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
  const paper = canvas.getContext('2d');
  const picture = await createImageBitmap(bytes).catch(() => undefined);
  if (!paper || !picture) return undefined;
  paper.fillStyle = '#fff'; // what shows through a PNG is paper
  paper.fillRect(0, 0, canvas.width, canvas.height);
  paper.drawImage(picture, 0, 0, canvas.width, canvas.height);
  picture.close();
  return new Promise((resolve) => canvas.toBlob((made) => resolve(made ?? undefined), 'image/jpeg', 0.85));
}
