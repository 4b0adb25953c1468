// The values of 16-bit grey PNGs, such as a thermal camera's images. A browser's own decoder keeps
// only 8 of the 16 bits.
import type { ValueImage } from "./valueImage";

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const MOST_PIXELS = 1 << 24;

// Returns null if `png` is not a complete 16-bit grey PNG without filters. gsv writes PNGs in this
// form.
export async function valuesOfGreyPng(png: Uint8Array): Promise<ValueImage | null> {
  const parts = partsOf(png);
  if (!parts) return null;
  const { width, height, packed } = parts;
  const rows = await inflated(packed).catch(() => null);
  const step = 1 + 2 * width; // a row begins with one byte for its filter
  if (rows?.byteLength !== step * height) return null;
  const bytes = new DataView(rows);
  for (let y = 0; y < height; y++) if (bytes.getUint8(y * step) !== 0) return null;
  const values = new Float32Array(width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) values[y * width + x] = bytes.getUint16(y * step + 1 + 2 * x);
  }
  return { width, height, values, unit: "" };
}

function partsOf(png: Uint8Array): { width: number; height: number; packed: Uint8Array<ArrayBuffer>[] } | null {
  if (SIGNATURE.some((byte, i) => png[i] !== byte) || png.byteLength < 33) return null;
  const bytes = new DataView(png.buffer, png.byteOffset, png.byteLength);
  const [width, height] = [bytes.getUint32(16), bytes.getUint32(20)];
  const isGrey16 = bytes.getUint8(24) === 16 && bytes.getUint8(25) === 0 && bytes.getUint8(28) === 0;
  if (!isGrey16 || width * height === 0 || width * height > MOST_PIXELS) return null;
  const packed: Uint8Array<ArrayBuffer>[] = [];
  for (let at = 8; at + 12 <= png.byteLength; ) {
    const length = bytes.getUint32(at);
    const isData = bytes.getUint32(at + 4) === 0x49444154; // IDAT
    if (isData) packed.push(new Uint8Array(png.slice(at + 8, at + 8 + length)));
    at += 12 + length;
  }
  return { width, height, packed };
}

function inflated(packed: Uint8Array<ArrayBuffer>[]): Promise<ArrayBuffer> {
  const stream = new Blob(packed).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}
