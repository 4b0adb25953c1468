// The shadow map of a sun. It covers a sphere around the visible part of the world. If the camera
// is near a robot, the texels are small enough for the shadow of a wheel. The sphere moves and
// grows in steps, so that shadows are seldom drawn again and their edges do not flicker.
import type { DirectionalLight, Sphere, Vector3 } from "three";

const SMALL_MAP = 1024; // texels; sufficient for a room
const LARGE_MAP = 2048;
const ROOM_RADIUS = 12; // m
const LARGEST_RADIUS = 40; // m: with a larger radius, a texel is wider than a robot's wheel
const SMALLEST_RADIUS = 3; // m
// Radius of the sphere, as a multiple of the distance from the camera to its target.
const REACH = 4;
const STEP = Math.SQRT2; // ratio of two successive radii
const BIAS = 0.0016; // fraction of the radius
// The sphere moves only if the distance of the camera's target from the sphere's centre exceeds
// this fraction of the sphere's radius.
const SLACK = 0.25;

export class FittedShadow {
  private readonly largest: number;
  private readonly centre: Vector3;
  private radius = 0; // m

  // `direction` is the direction of the light, with unit length. `world` contains everything on
  // which a shadow may fall.
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

  // Fits the map to the view of a camera at `eye` with this target. Returns whether the map has
  // changed.
  fit(eye: Vector3, target: Vector3): boolean {
    const radius = this.radiusFor(eye.distanceTo(target));
    const centre = radius < this.largest ? target : this.world.center;
    if (radius === this.radius && centre.distanceTo(this.centre) <= SLACK * radius) return false;
    this.place(radius, centre);
    return true;
  }

  // Returns the radius for a distance: the largest radius divided by a power of STEP.
  private radiusFor(distance: number): number {
    const wanted = Math.max(SMALLEST_RADIUS, REACH * distance);
    if (wanted >= this.largest) return this.largest;
    return this.largest / STEP ** Math.floor(Math.log(this.largest / wanted) / Math.log(STEP));
  }

  private place(radius: number, centre: Vector3): void {
    this.radius = radius;
    this.centre.copy(centre);
    const { sun } = this;
    const away = 2 * this.largest; // far enough that the light is above all bodies
    sun.target.position.copy(centre);
    sun.position.copy(centre).addScaledVector(this.direction, -away);
    for (const each of [sun, sun.target]) each.updateMatrixWorld();
    const { camera } = sun.shadow;
    camera.left = camera.bottom = -radius;
    camera.right = camera.top = radius;
    camera.near = 0.1;
    camera.far = 2 * away;
    camera.updateProjectionMatrix();
    // Offsets of about a texel, along the normal and towards the light, prevent surfaces from
    // shading themselves.
    sun.shadow.bias = (-BIAS * radius) / camera.far;
    sun.shadow.normalBias = (2 * radius * 1.5) / sun.shadow.mapSize.x;
  }
}

