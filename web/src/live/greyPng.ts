// 16-bit grey PNGs, such as a thermal camera's images, in colours: from the least value in the image,
// dark, to the largest, bright. A browser's own decoder keeps 8 of the 16 bits.

export interface ColouredImage {
  width: number;
  height: number;
  rgba: Uint8ClampedArray<ArrayBuffer>;
}

const SIGNATURE = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const MOST_PIXELS = 1 << 24;

// The colour map "inferno" (Smith and van der Walt), in between by straight lines.
const STOPS = [
  [0, 0, 4],
  [66, 10, 104],
  [147, 38, 103],
  [221, 81, 58],
  [252, 165, 10],
  [252, 255, 164],
] as const;

// Null: it is no 16-bit grey PNG without filters, as gsv writes them, or not whole.
export async function colouredGreyPng(png: Uint8Array): Promise<ColouredImage | null> {
  const parts = partsOf(png);
  if (!parts) return null;
  const { width, height, packed } = parts;
  const rows = await inflated(packed).catch(() => null);
  const step = 1 + 2 * width; // each row begins with its filter
  if (rows?.byteLength !== step * height) return null;
  const bytes = new DataView(rows);
  for (let y = 0; y < height; y++) if (bytes.getUint8(y * step) !== 0) return null;
  return coloured(width, height, (x, y) => bytes.getUint16(y * step + 1 + 2 * x));
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

function coloured(width: number, height: number, valueAt: (x: number, y: number) => number): ColouredImage {
  let [least, largest] = [Infinity, -Infinity];
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      least = Math.min(least, valueAt(x, y));
      largest = Math.max(largest, valueAt(x, y));
    }
  }
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      rgba.set(colourAt((valueAt(x, y) - least) / Math.max(1, largest - least)), 4 * (y * width + x));
    }
  }
  return { width, height, rgba };
}

// Of a part from 0 to 1.
function colourAt(part: number): [number, number, number, number] {
  const place = part * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  const channel = (i: 0 | 1 | 2) => {
    const [from, to] = [STOPS[below]![i], STOPS[below + 1]![i]];
    return from + (place - below) * (to - from);
  };
  return [channel(0), channel(1), channel(2), 255];
}
