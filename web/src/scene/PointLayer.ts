// Draws the points measured by sensors in one draw call. Like beams, they move with the displayed
// sensor.
import type { Matrix4 } from "three";
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, PointsMaterial, Vector3 } from "three";

const SIZE_PX = 3;
const COLOUR = 0xff9d1f;
const SMALLEST_CAPACITY = 1024; // points

export class PointLayer {
  readonly points: Points<BufferGeometry, PointsMaterial>;
  private readonly clouds = new Map<string, Float32Array>(); // by topic, in the sensor's frame
  private positions = new Float32Array(0);

  constructor() {
    const material = new PointsMaterial({
      size: SIZE_PX,
      sizeAttenuation: false,
      color: COLOUR,
      toneMapped: false,
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.raycast = () => {};
    this.grow(SMALLEST_CAPACITY);
  }

  get count(): number {
    return this.points.geometry.drawRange.count;
  }

  set(topic: string, pointsInSensor: Float32Array): void {
    this.clouds.set(topic, pointsInSensor);
  }

  keepOnly(topics: ReadonlySet<string>): void {
    for (const topic of [...this.clouds.keys()]) if (!topics.has(topic)) this.clouds.delete(topic);
  }

  // Moves the points with the displayed sensors.
  place(worldFromSensor: (topic: string) => Matrix4 | null): void {
    let numbers = 0;
    for (const cloud of this.clouds.values()) numbers += cloud.length;
    if (numbers > this.positions.length) this.grow(numbers / 3);
    const point = new Vector3();
    let at = 0;
    for (const [topic, cloud] of this.clouds) {
      const frame = worldFromSensor(topic);
      if (!frame) continue;
      for (let i = 0; i < cloud.length; i += 3, at += 3) {
        point.fromArray(cloud, i).applyMatrix4(frame).toArray(this.positions, at);
      }
    }
    this.points.geometry.setDrawRange(0, at / 3);
    this.points.geometry.getAttribute("position").needsUpdate = true;
  }

  private grow(points: number): void {
    const capacity = Math.max(SMALLEST_CAPACITY, 2 ** Math.ceil(Math.log2(points)));
    this.positions = new Float32Array(3 * capacity);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    geometry.setDrawRange(0, 0);
    this.points.geometry.dispose();
    this.points.geometry = geometry;
  }
}
