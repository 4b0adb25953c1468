// Images whose pixels are values, such as depths in metres. These images are drawn in colours. The
// page also shows the value under the pointer.
import type { PointCloud } from "./clouds";

export interface ValueImage {
  width: number;
  height: number;
  values: Float32Array; // rows from the top; NaN or infinite where nothing was measured
  unit: string;
}

export interface ColouredImage {
  width: number;
  height: number;
  rgba: Uint8ClampedArray<ArrayBuffer>;
}

const MAX_PIXELS = 1 << 24;
const FLOAT32 = 7;

// The colour map "inferno" (Smith and van der Walt), interpolated linearly between these colours.
const STOPS = [
  [0, 0, 4],
  [66, 10, 104],
  [147, 38, 103],
  [221, 81, 58],
  [252, 165, 10],
  [252, 255, 164],
] as const;
const CHANNELS = Float64Array.from(STOPS.flat()); // r g b of each stop
const NOTHING = [32, 38, 46] as const; // the colour of pixels without a measurement

// The image of a depth camera: the distance along the viewing direction, which is x in the camera's
// frame. Returns null if the cloud has no rows.
export function depthImageOf({ width, height, fields, data, point_step, row_step, is_bigendian }: PointCloud): ValueImage | null {
  const x = fields.find(({ name, datatype }) => name === "x" && datatype === FLOAT32);
  const isWhole = height > 1 && width > 0 && width * height <= MAX_PIXELS && point_step >= 4 && row_step >= width * point_step;
  if (!x || !isWhole || x.offset + 4 > point_step || data.byteLength < height * row_step) return null;
  const bytes = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const values = new Float32Array(width * height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      values[row * width + column] = bytes.getFloat32(row * row_step + column * point_step + x.offset, !is_bigendian);
    }
  }
  return { width, height, values, unit: "m" };
}

// Returns the smallest and the largest finite value. If there are no finite values, returns two
// equal numbers.
export function spanOf(values: Float32Array): [number, number] {
  let [least, largest] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < least) least = value;
    if (value > largest) largest = value;
  }
  return least <= largest ? [least, largest] : [0, 0];
}

// Returns the colours of the values, from dark (smallest) to bright (largest).
export function coloured({ width, height, values }: ValueImage): ColouredImage {
  const [least, largest] = spanOf(values);
  const scale = largest > least ? 1 / (largest - least) : 0;
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (let i = 0, at = 0; i < values.length; i++, at += 4) {
    const value = values[i]!;
    const isMeasured = Number.isFinite(value);
    for (let k = 0; k < 3; k++) rgba[at + k] = isMeasured ? channelAt((value - least) * scale, k) : NOTHING[k]!;
    rgba[at + 3] = 255;
  }
  return { width, height, rgba };
}

export const SCALE_CSS = `linear-gradient(to right, ${STOPS.map((stop) => `rgb(${stop.join(" ")})`).join(", ")})`;

// Returns the colour of a value that is scaled to the range from 0 to 1.
export function colourAt(part: number): [number, number, number, number] {
  return [channelAt(part, 0), channelAt(part, 1), channelAt(part, 2), 255];
}

function channelAt(part: number, channel: number): number {
  const place = part * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  const from = CHANNELS[3 * below + channel]!;
  return from + (place - below) * (CHANNELS[3 * below + 3 + channel]! - from);
}
