// Draws the points measured by sensors in one draw call, coloured by distance, height or intensity.
// The points move with the displayed sensor, like beams.
import type { Matrix4 } from "three";
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Points, PointsMaterial, SRGBColorSpace, Vector3 } from "three";
import type { Points as Cloud } from "../live/clouds";
import { colourAt, spanOf } from "../live/valueImage";
import type { PointColour } from "../state/overlays";

const SIZE_PX = 3;
const SMALLEST_CAPACITY = 1024; // points
// The lower end of the colour scale. Darker points would not stand out from the floor.
const DARKEST = 0.25;
// The upper end of the colour scale. Brighter points would not stand out from a light floor.
const BRIGHTEST = 0.85;
const LEVELS = 65; // number of colours in the scale

export class PointLayer {
  readonly points: Points<BufferGeometry, PointsMaterial>;
  colour: PointColour = "range";
  private readonly clouds = new Map<string, Cloud>(); // by topic, in the sensor's frame
  private positions = new Float32Array(0);
  private colours = new Float32Array(0);
  private values = new Float32Array(0); // the values that the colours represent

  constructor() {
    const material = new PointsMaterial({ size: SIZE_PX, sizeAttenuation: false, vertexColors: true, toneMapped: false });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.raycast = () => {};
    this.grow(SMALLEST_CAPACITY);
  }

  get count(): number {
    return this.points.geometry.drawRange.count;
  }

  set(topic: string, cloud: Cloud): void {
    this.clouds.set(topic, cloud);
  }

  keepOnly(topics: ReadonlySet<string>): void {
    for (const topic of [...this.clouds.keys()]) if (!topics.has(topic)) this.clouds.delete(topic);
  }

  // Moves the points with the displayed sensors.
  place(worldFromSensor: (topic: string) => Matrix4 | null): void {
    let count = 0;
    for (const { points } of this.clouds.values()) count += points.length / 3;
    if (count > this.values.length) this.grow(count);
    const point = new Vector3();
    let at = 0;
    for (const [topic, { points, intensities }] of this.clouds) {
      const frame = worldFromSensor(topic);
      if (!frame) continue;
      for (let i = 0; i < points.length; i += 3, at += 1) {
        const range = point.fromArray(points, i).length();
        point.applyMatrix4(frame).toArray(this.positions, 3 * at);
        this.values[at] = this.colour === "height" ? point.z : (this.colour === "intensity" ? (intensities?.[i / 3] ?? range) : range);
      }
    }
    this.paint(at);
    this.points.geometry.setDrawRange(0, at);
    for (const name of ["position", "color"]) this.points.geometry.getAttribute(name).needsUpdate = true;
  }

  // Colours the points, from the smallest value (dark) to the largest (bright).
  private paint(count: number): void {
    const [least, largest] = spanOf(this.values.subarray(0, count));
    const scale = largest > least ? (LEVELS - 1) / (largest - least) : 0;
    for (let i = 0; i < count; i++) {
      const colour = SCALE[Math.round((this.values[i]! - least) * scale)] ?? SCALE[0]!;
      this.colours.set(colour, 3 * i);
    }
  }

  private grow(points: number): void {
    const capacity = Math.max(SMALLEST_CAPACITY, 2 ** Math.ceil(Math.log2(points)));
    this.positions = new Float32Array(3 * capacity);
    this.colours = new Float32Array(3 * capacity);
    this.values = new Float32Array(capacity);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute("color", new BufferAttribute(this.colours, 3).setUsage(DynamicDrawUsage));
    geometry.setDrawRange(0, 0);
    this.points.geometry.dispose();
    this.points.geometry = geometry;
  }
}

// The colours of the scale, as three.js draws with them.
const SCALE = Array.from({ length: LEVELS }, (_, i) => scaleColour(i / (LEVELS - 1)));

// Returns the colour of a value from 0 to 1.
export function scaleColour(part: number): [number, number, number] {
  const [r, g, b] = colourAt(DARKEST + (BRIGHTEST - DARKEST) * Math.min(1, Math.max(0, part)));
  return new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray() as [number, number, number];
}
