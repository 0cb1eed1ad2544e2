import { expect, it } from 'vitest';
import { readPicture, sizeOf } from './picture_file';

const png = (width: number, height: number): Uint8Array => {
  const bytes = new Uint8Array(33);
  bytes.set([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);
  new DataView(bytes.buffer).setUint32(16, width);
  new DataView(bytes.buffer).setUint32(20, height);
  return bytes;
};
/** With a segment before that of the frame, as cameras write it. */
const jpeg = new Uint8Array([
  0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xff, 0xc4, 0, 3, 9, 0xff, 0xc2, 0, 11, 8, 0x01, 0x2c, 0x02, 0x58, 3, 0, 0, 0,
]);

const file = (bytes: Uint8Array, name = 'plan.png'): File => {
  const made = new File([bytes as never], name);
  Object.defineProperty(made, 'arrayBuffer', { value: () => Promise.resolve(bytes.buffer) }); // jsdom has none
  return made;
};

it('reads the size of PNG and JPEG, progressive ones too', () => {
  expect(sizeOf(png(640, 480))).toEqual({ media_type: 'image/png', width: 640, height: 480 });
  expect(sizeOf(jpeg)).toEqual({ media_type: 'image/jpeg', width: 600, height: 300 });
});

it('takes nothing for a picture that is none, wherever it is cut off', () => {
  for (const bytes of [new Uint8Array(), new TextEncoder().encode('<svg xmlns="..."></svg> and more of it')])
    expect(sizeOf(bytes)).toBeUndefined();
  for (let length = 0; length < 20; length += 1) expect(sizeOf(jpeg.slice(0, length))).toBeUndefined();
  for (let length = 0; length < 24; length += 1) expect(sizeOf(png(1, 1).slice(0, length))).toBeUndefined();
});

it('says what is wrong with a file', async () => {
  expect(await readPicture(file(png(640, 480)))).toMatchObject({ width: 640, name: 'plan.png' });
  expect(await readPicture(file(png(9000, 10)))).toMatch(/9000 x 10 px/);
  expect(await readPicture(file(png(0, 10)))).toMatch(/neither/);
  expect(await readPicture(file(new Uint8Array(50), 'plan.dwg'))).toBe('plan.dwg is neither a PNG nor a JPEG picture.');
  const large = file(png(1, 1));
  Object.defineProperty(large, 'size', { value: 40e6 });
  expect(await readPicture(large)).toMatch(/40 MB/);
});
