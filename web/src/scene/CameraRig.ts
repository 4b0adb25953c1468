// The eye: orbits, flies to views, follows a robot. The world's z is up.
import type { Box3 } from "three";
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { fittingDistance } from "./framing";

const FIELD_OF_VIEW_DEG = 50;
const FLIGHT_MS = 450;
const MARGIN = 1.04;
// From the south-west, well above: over the walls of a room into it.
const FIRST_DIRECTION = new Vector3(0.35, 0.72, -0.85).normalize();
// Not quite straight down, where the orbit would have no heading: north is up in the picture.
const DOWN = new Vector3(0, 0.001, -1).normalize();
const FOLLOWING_DISTANCE = 5; // m
const FOLLOWING_STEEPNESS = Math.tan((68 * Math.PI) / 180); // over the walls beside a robot

interface Flight {
  fromPosition: Vector3;
  fromTarget: Vector3;
  toPosition: Vector3;
  toTarget: Vector3;
  startMs: number;
}

export class CameraRig {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.05, 500);
  readonly controls: OrbitControls;
  private flight: Flight | null = null;
  private followed: Vector3 | null = null;
  private readonly still: boolean;

  constructor(canvas: HTMLElement, onChange: () => void) {
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-4, -8, 8);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.18;
    this.controls.zoomToCursor = true;
    this.controls.maxPolarAngle = Math.PI * 0.495; // not below the floor
    this.controls.minDistance = 0.3;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => (this.flight = null));
    this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
  }

  // Shows the box from above at an angle; at once when `fly` is false.
  frame(box: Box3, fly: boolean): void {
    this.lookAt(box, FIRST_DIRECTION, fly);
  }

  top(box: Box3): void {
    this.lookAt(box, DOWN, true);
  }

  // Keeps `position` in the picture from now on as it moves; null ends it.
  follow(position: Vector3 | null): void {
    if (!position) {
      this.followed = null;
      return;
    }
    if (this.followed) return;
    this.followed = position.clone();
    const back = steepened(this.camera.position.clone().sub(this.controls.target));
    const distance = Math.min(back.length(), FOLLOWING_DISTANCE);
    this.fly(position.clone().add(back.setLength(distance)), position.clone());
  }

  // Moves along with the followed robot.
  moveTo(position: Vector3): void {
    if (!this.followed) return;
    const shift = position.clone().sub(this.followed);
    this.followed.copy(position);
    if (shift.lengthSq() === 0) return;
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    for (const point of [
      this.flight?.fromPosition,
      this.flight?.fromTarget,
      this.flight?.toPosition,
      this.flight?.toTarget,
    ]) {
      point?.add(shift);
    }
  }

  // Whether the camera still moves by itself after this frame.
  update(nowMs: number): boolean {
    if (this.flight) this.advanceFlight(this.flight, nowMs);
    const moved = this.controls.update();
    return moved || this.flight !== null;
  }

  private lookAt(box: Box3, direction: Vector3, fly: boolean): void {
    const target = box.getCenter(new Vector3());
    const distance = MARGIN * fittingDistance(this.camera, box, direction);
    const position = target.clone().addScaledVector(direction, -distance);
    this.controls.maxDistance = Math.max(50, 6 * distance);
    this.camera.far = 3 * this.controls.maxDistance;
    this.camera.near = Math.min(0.1, distance / 100);
    this.camera.updateProjectionMatrix();
    if (fly) {
      this.fly(position, target);
      return;
    }
    this.flight = null;
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
  }

  private fly(toPosition: Vector3, toTarget: Vector3): void {
    this.flight = {
      fromPosition: this.camera.position.clone(),
      fromTarget: this.controls.target.clone(),
      toPosition,
      toTarget,
      startMs: this.still ? -Infinity : performance.now(),
    };
    this.controls.dispatchEvent({ type: "change" });
  }

  private advanceFlight(flight: Flight, nowMs: number): void {
    const share = Math.min(1, (nowMs - flight.startMs) / FLIGHT_MS);
    const eased = share < 0.5 ? 4 * share ** 3 : 1 - (-2 * share + 2) ** 3 / 2;
    this.camera.position.lerpVectors(flight.fromPosition, flight.toPosition, eased);
    this.controls.target.lerpVectors(flight.fromTarget, flight.toTarget, eased);
    if (share >= 1) this.flight = null;
  }
}

// The same heading, from no lower than one follows a robot.
function steepened(back: Vector3): Vector3 {
  back.z = Math.max(back.z, FOLLOWING_STEEPNESS * Math.hypot(back.x, back.y));
  return back;
}
