// The shadow map of a sun, fitted to what the camera sees: near a robot, its texels are small enough
// for the shadow of a wheel. It moves and grows in steps, so that shadows are seldom drawn again and
// their edges do not crawl.
import type { DirectionalLight, Sphere, Vector3 } from "three";

const SMALL_MAP = 1024; // texels; enough for a room
const LARGE_MAP = 2048;
const ROOM_RADIUS = 12; // m
const LARGEST_RADIUS = 40; // m: beyond, a texel is wider than a robot's wheel
const SMALLEST_RADIUS = 3; // m
// The shadowed radius as a multiple of the camera's distance from what it looks at.
const REACH = 4;
const STEP = Math.SQRT2; // between two radii
const BIAS = 0.0016; // of the radius
const SLACK = 0.25; // of the radius: how far the view moves before the shadows follow

export class FittedShadow {
  private readonly largest: number;
  private readonly centre: Vector3;
  private radius = 0; // m

  // `direction` of the light, unit length. `world`: what can be shadowed.
  constructor(
    private readonly sun: DirectionalLight,
    private readonly direction: Vector3,
    private readonly world: Sphere,
  ) {
    this.largest = Math.min(LARGEST_RADIUS, Math.max(1, world.radius));
    this.centre = world.center.clone();
    const texels = this.largest <= ROOM_RADIUS ? SMALL_MAP : LARGE_MAP;
    sun.castShadow = true;
    sun.shadow.mapSize.set(texels, texels);
    this.place(this.largest, world.center);
  }

  // Fits it to what a camera at `eye` sees around `target`. Returns whether it has changed.
  fit(eye: Vector3, target: Vector3): boolean {
    const radius = this.radiusFor(eye.distanceTo(target));
    const centre = radius < this.largest ? target : this.world.center;
    if (radius === this.radius && centre.distanceTo(this.centre) <= SLACK * radius) return false;
    this.place(radius, centre);
    return true;
  }

  // The largest radius divided by a power of STEP.
  private radiusFor(distance: number): number {
    const wanted = Math.max(SMALLEST_RADIUS, REACH * distance);
    if (wanted >= this.largest) return this.largest;
    return this.largest / STEP ** Math.floor(Math.log(this.largest / wanted) / Math.log(STEP));
  }

  private place(radius: number, centre: Vector3): void {
    this.radius = radius;
    this.centre.copy(centre);
    const { sun } = this;
    const away = 2 * this.largest; // the light passes over what is lower
    sun.target.position.copy(centre);
    sun.position.copy(centre).addScaledVector(this.direction, -away);
    for (const each of [sun, sun.target]) each.updateMatrixWorld();
    const { camera } = sun.shadow;
    camera.left = camera.bottom = -radius;
    camera.right = camera.top = radius;
    camera.near = 0.1;
    camera.far = 2 * away;
    camera.updateProjectionMatrix();
    // Offsets of about a texel, along the normal and towards the light, prevent surfaces from shading
    // themselves.
    sun.shadow.bias = (-BIAS * radius) / camera.far;
    sun.shadow.normalBias = (2 * radius * 1.5) / sun.shadow.mapSize.x;
  }
}

