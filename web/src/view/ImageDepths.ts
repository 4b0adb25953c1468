// The depths of an image of the server, which hide the parts of overlays behind surfaces. The
// server writes them into the JPEG (gsv/rendering/images/depth_segment.h describes the format).

const MAX_SAMPLES = 20_000; // the server's limit
const MIN_SPACING_PX = 8;
const MARKER = 0xe9; // APP9
const START_OF_SCAN = 0xda;
const IDENTIFIER = "GSV-depth\0";
const HEADER_BYTES = IDENTIFIER.length + 10;
// A point is hidden only if it is behind a surface by more than this fraction of its depth, so that
// points on a surface are visible.
const TOLERANCE = 0.005;
const ROUNDING = 1; // the error of an interpolated number

// Returns the smallest distance in pixels between depths that the server supports for this size.
export function depthSpacing(width: number, height: number): number {
  let spacing = MIN_SPACING_PX;
  while (samplesIn(width, spacing) * samplesIn(height, spacing) > MAX_SAMPLES) spacing += 1;
  return spacing;
}

// Returns the depths in a JPEG; null if it has none.
export function depthsOf(jpeg: Uint8Array): ImageDepths | null {
  const bytes = new DataView(jpeg.buffer, jpeg.byteOffset, jpeg.byteLength);
  for (let at = 2; at + 4 <= jpeg.length && jpeg[at] === 0xff && jpeg[at + 1] !== START_OF_SCAN; ) {
    const end = at + 2 + bytes.getUint16(at + 2);
    const content = new Uint8Array(jpeg.buffer, jpeg.byteOffset + at + 4, Math.max(0, Math.min(end, jpeg.length) - at - 4));
    if (jpeg[at + 1] === MARKER && startsWithIdentifier(content)) return read(content);
    at = end;
  }
  return null;
}

export class ImageDepths {
  private readonly columns: number;

  // Each of `numbers` is `scale` / depth (depth in metres), or 0 for the background.
  constructor(
    readonly width: number, // size of the image in pixels
    readonly height: number,
    readonly spacing: number,
    private readonly scale: number,
    private readonly numbers: Uint16Array,
  ) {
    this.columns = samplesIn(width, spacing);
  }

  // Whether a surface hides the point at these coordinates of the image, from 0 to 1, that has this
  // depth along the camera's axis. A point is hidden only if both the nearest sample and the
  // interpolation between four samples are nearer: the interpolation is exact on planes, and the
  // nearest sample at the borders of objects.
  hides(u: number, v: number, depth: number): boolean {
    const [x0, x1, s] = this.between(u, this.width);
    const [y0, y1, t] = this.between(v, this.height);
    const { numbers, columns } = this;
    const upper = y0 * columns;
    const lower = y1 * columns;
    const limit = (this.scale / depth) * (1 + TOLERANCE) + ROUNDING;
    const nearest = numbers[(t < 0.5 ? upper : lower) + (s < 0.5 ? x0 : x1)]!;
    if (nearest <= limit) return false;
    const above = numbers[upper + x0]! + s * (numbers[upper + x1]! - numbers[upper + x0]!);
    const below = numbers[lower + x0]! + s * (numbers[lower + x1]! - numbers[lower + x0]!);
    return above + t * (below - above) > limit;
  }

  // Returns the samples before and after a coordinate from 0 to 1, and the place between them.
  private between(share: number, size: number): [number, number, number] {
    const pixel = Math.min(Math.max(share * size - 0.5, 0), size - 1);
    const before = Math.floor(pixel / this.spacing);
    const start = before * this.spacing;
    const end = Math.min(start + this.spacing, size - 1);
    return end > start ? [before, before + 1, (pixel - start) / (end - start)] : [before, before, 0];
  }
}

function samplesIn(pixels: number, spacing: number): number {
  return Math.ceil(Math.max(pixels - 1, 0) / spacing) + 1;
}

function startsWithIdentifier(content: Uint8Array): boolean {
  return content.length >= HEADER_BYTES && [...IDENTIFIER].every((letter, i) => content[i] === letter.charCodeAt(0));
}

function read(content: Uint8Array): ImageDepths | null {
  const header = new DataView(content.buffer, content.byteOffset + IDENTIFIER.length);
  const [width, height, spacing] = [0, 2, 4].map((at) => header.getUint16(at, true)) as [number, number, number];
  if (spacing === 0) return null;
  const columns = samplesIn(width, spacing);
  const count = columns * samplesIn(height, spacing);
  const numbers = count <= MAX_SAMPLES ? numbersOf(content.subarray(HEADER_BYTES), columns, count) : null;
  return numbers && new ImageDepths(width, height, spacing, header.getFloat32(6, true), numbers);
}

// Returns null if the data are too short.
function numbersOf(data: Uint8Array, columns: number, count: number): Uint16Array | null {
  const numbers = new Uint16Array(count);
  let at = 0; // in half bytes
  for (let i = 0; i < count; i++) {
    let zigzag = 0;
    for (let shift = 0; ; shift += 3, at++) {
      if (at >> 1 >= data.length) return null;
      const group = (data[at >> 1]! >> (4 * (at & 1))) & 15;
      zigzag |= (group & 7) << shift;
      if (group < 8) break;
    }
    at += 1;
    const hasLeft = i % columns > 0;
    const hasAbove = i >= columns;
    const left = hasLeft ? numbers[i - 1]! : 0;
    const above = hasAbove ? numbers[i - columns]! : 0;
    const aboveLeft = hasLeft && hasAbove ? numbers[i - columns - 1]! : 0;
    numbers[i] = left + above - aboveLeft + ((zigzag >>> 1) ^ -(zigzag & 1));
  }
  return numbers;
}
