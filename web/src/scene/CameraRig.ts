// The camera of the view: orbits, flies to views, follows a robot, or shows a robot's view. The
// world's z is up. If the camera follows behind a robot and a wall hides the robot, the camera
// moves nearer to it.
import type { Box3 } from "three";
import { MOUSE, MathUtils, Matrix4, PerspectiveCamera, TOUCH, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { CameraView } from "../api/scene";
import type { Viewpoint as ViewNumbers } from "../state/link";
import type { Eye } from "./eye";
import { cameraRotation, fieldOfViewDeg } from "./eye";
import { fittingDistance } from "./framing";

const { clamp, degToRad: radians } = MathUtils;

const FIELD_OF_VIEW_DEG = 50;
// The field of view of a map. It is so narrow that the map deviates from an orthographic map by
// less than 1%. The server supports no narrower field of view.
const MAP_FIELD_OF_VIEW_DEG = 1;
const FARTHEST_MAP = 900_000; // m: largest distance of the camera; the server allows 1,000,000 m
// m: a map shows everything that is at most this far below or above the camera's target
const MAP_DEPTH = 200;
const FLIGHT_MS = 450;
const MARGIN = 1.04;
// The direction of the first view: from the south-west, and steep enough to see over the walls of a
// room.
const FIRST_DIRECTION = new Vector3(0.35, 0.72, -0.85).normalize();
// Straight down, but not exactly vertical, because a vertical view has no heading. North is up.
const DOWN = new Vector3(0, 0.001, -1).normalize();
const FOLLOWING_DISTANCE = 5; // m
// Steep enough to see over the walls beside a robot.
const FOLLOWING_STEEPNESS = Math.tan((68 * Math.PI) / 180);
const BEHIND = 2.4; // m: distance behind a followed robot
const ABOVE = 1.5;
const NEAREST = 0.4; // m: smallest distance to the followed robot
const BEFORE_WALL = 0.15; // m: distance of the camera from a wall behind it
const LOOK_MS = 100; // time between checks for walls
// Time in which the camera moves back when no wall hides the robot any more.
const BACK_OFF_MS = 250;
// m: when the view of a robot's eye ends, the camera's target is set this far ahead of the eye.
const AHEAD = 2;

// A robot that is followed: its position, the centre of its shape, and the direction of its x axis
// (radians about the world's z). Until the shape is known, the centre equals the position.
export interface Subject {
  position: Vector3;
  middle: Vector3;
  yaw: number;
}

export interface Viewpoint {
  position: Vector3;
  target: Vector3;
}

interface Flight {
  from: Viewpoint;
  to: Viewpoint;
  startMs: number;
}

export class CameraRig {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.05, 500); // the camera that draws
  readonly controls: OrbitControls; // controls that move the camera `stand`
  // The camera as the user has placed it. If a wall would hide the robot from there, `camera` is
  // nearer to the robot.
  private readonly stand = this.camera.clone();
  private free = Infinity; // m: free distance from the followed robot towards the camera
  private looked = -Infinity; // ms
  private drawn = Infinity; // m: distance of `camera` from its target in the last image
  private drawnMs = 0;
  private flight: Flight | null = null;
  private subject: Subject | null = null;
  private turning = false; // whether the camera rotates with the subject
  // The view before the view of a robot; null if no robot's view is shown.
  private beforeEye: Viewpoint | null = null;
  private eyeView: CameraView | null = null; // field of view of the robot's camera
  private beforeMap: Viewpoint | null = null; // the view before the map; null if no map is shown
  private height = 1; // px
  // m: the range of depths that is drawn in all views except the map
  private orbitDepth = { near: 0.05, far: 500 };
  private readonly still: boolean;

  // `freeAlong` returns the free distance in metres from a place in a direction (unit length), up
  // to `far`. If nothing is in the way, the result may be larger than `far`.
  constructor(
    canvas: HTMLElement,
    onChange: () => void,
    private readonly freeAlong: (from: Vector3, direction: Vector3, far: number) => number = () => Infinity,
  ) {
    for (const each of [this.stand, this.camera]) each.up.set(0, 0, 1);
    this.stand.position.set(-4, -8, 8);
    this.controls = new OrbitControls(this.stand, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.18;
    this.controls.zoomToCursor = true;
    this.controls.maxPolarAngle = Math.PI * 0.495; // the camera stays above the floor
    this.controls.minDistance = 0.3;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => (this.flight = null));
    this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  resize(width: number, height: number): void {
    this.height = Math.max(1, height);
    this.stand.aspect = this.camera.aspect = width / this.height;
    this.widen();
  }

  // The position and target of the camera. During a flight, the position and target at the end of
  // the flight. While a robot's view is shown, the position and target to which the camera returns.
  get viewpoint(): Viewpoint {
    const { position, target } = this.flight?.to ??
      this.beforeEye ?? { position: this.stand.position, target: this.controls.target };
    return { position: position.clone(), target: target.clone() };
  }

  // Moves the camera at once. While a robot's view is shown, the camera moves when that view ends.
  set viewpoint({ position, target }: Viewpoint) {
    this.flight = null;
    if (this.beforeEye) {
      this.beforeEye = { position: position.clone(), target: target.clone() };
      return;
    }
    this.stand.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.draw(performance.now());
    this.controls.dispatchEvent({ type: "change" });
  }

  // The camera as numbers for a link. While a map is shown, the numbers describe the view before
  // the map was opened.
  get viewNumbers(): ViewNumbers {
    const { position, target } = this.beforeMap ?? this.viewpoint;
    return [...position.toArray(), ...target.toArray()];
  }

  set viewNumbers([x, y, z, tx, ty, tz]: ViewNumbers) {
    this.viewpoint = { position: new Vector3(x, y, z), target: new Vector3(tx, ty, tz) };
  }

  // Shows the box obliquely from above. If `fly` is false, the camera is there at once.
  frame(box: Box3, fly: boolean): void {
    this.lookAt(box, FIRST_DIRECTION, fly);
  }

  top(box: Box3): void {
    this.lookAt(box, DOWN, true);
  }

  // Shows the view from above, north up and without perspective. Dragging moves the map. The centre
  // and the scale of the view do not change.
  setMap(isOn: boolean): void {
    if (isOn === (this.beforeMap !== null)) return;
    const { position, target } = this.viewpoint;
    const { controls } = this;
    this.flight = null;
    if (isOn) {
      const scale = Math.tan(radians(FIELD_OF_VIEW_DEG) / 2) / Math.tan(radians(MAP_FIELD_OF_VIEW_DEG) / 2);
      const distance = Math.min(position.distanceTo(target) * scale, FARTHEST_MAP);
      controls.maxDistance = Math.min(controls.maxDistance * scale, FARTHEST_MAP);
      this.beforeMap = { position, target };
      this.setGestures();
      this.widen();
      this.viewpoint = { position: target.clone().addScaledVector(DOWN, -distance), target };
    } else {
      const before = this.beforeMap!;
      this.beforeMap = null;
      controls.maxDistance /= Math.tan(radians(FIELD_OF_VIEW_DEG) / 2) / Math.tan(radians(MAP_FIELD_OF_VIEW_DEG) / 2);
      this.setGestures();
      this.setDepth(this.orbitDepth.near, this.orbitDepth.far);
      this.widen();
      this.viewpoint = before;
    }
  }

  // The width of a pixel in metres, at the distance of the camera's target.
  get metresPerPixel(): number {
    const distance = this.stand.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan(radians(this.camera.fov) / 2)) / this.height;
  }

  // Flies to the subject and follows it. If `subject` is null, ends following. If `turning` is
  // true, the camera stays behind the subject and rotates with it.
  follow(subject: Subject | null, turning = false): void {
    if (!subject) {
      if (this.subject && this.turning) this.stayBeforeWall();
      this.subject = null;
      return;
    }
    if (this.subject && this.turning === turning) return;
    this.subject = { ...subject, position: subject.position.clone() };
    this.turning = turning;
    this.looked = -Infinity;
    const target = subject.middle.clone();
    this.fly({ position: target.clone().add(turning ? behind(subject.yaw) : this.overhead()), target });
  }

  // Moves the camera with the followed robot.
  moveTo({ position, middle, yaw }: Subject): void {
    const { subject } = this;
    if (!subject) return;
    const turn = this.turning ? yaw - subject.yaw : 0;
    const isStill = turn === 0 && subject.position.equals(position);
    const motion = new Matrix4()
      .makeTranslation(position)
      .multiply(new Matrix4().makeRotationZ(turn))
      .multiply(new Matrix4().makeTranslation(subject.position.clone().negate()));
    this.subject = { position: position.clone(), middle, yaw };
    if (isStill) return;
    for (const point of this.points()) point.applyMatrix4(motion);
  }

  // Shows the scene from a robot's camera. If `eye` is null, returns to the view before that.
  lookFrom(eye: Eye | null): void {
    if (!eye) return this.leaveEye();
    const { worldFromEye, view } = eye;
    this.beforeEye ??= this.viewpoint;
    this.eyeView = view;
    this.widen();
    this.flight = null;
    this.controls.enabled = false;
    this.camera.position.setFromMatrixPosition(worldFromEye);
    this.camera.quaternion.copy(cameraRotation(worldFromEye));
    this.camera.updateMatrixWorld();
  }

  // Moves the camera for the next frame. Returns whether it will move by itself after this frame,
  // too.
  update(nowMs: number): boolean {
    if (this.beforeEye) return false;
    if (this.flight) this.advanceFlight(this.flight, nowMs);
    const moved = this.controls.update();
    const isBackingOff = this.draw(nowMs);
    return moved || isBackingOff || this.flight !== null;
  }

  // When the camera stops following a robot, it stays where the last image was drawn from.
  private stayBeforeWall(): void {
    if (!this.beforeEye) this.stand.position.copy(this.camera.position);
  }

  // Places `camera`, from which the image is drawn, at `stand`. If `stand` follows behind a robot
  // and a wall is between them, places `camera` in front of the wall. Returns whether `camera`
  // still has to move back towards `stand`.
  private draw(nowMs: number): boolean {
    this.camera.position.copy(this.stand.position);
    this.camera.quaternion.copy(this.stand.quaternion);
    if (this.beforeMap) {
      const distance = this.stand.position.distanceTo(this.controls.target);
      this.setDepth(Math.max(0.1, distance - MAP_DEPTH), distance + MAP_DEPTH);
    }
    const back = this.stand.position.clone().sub(this.controls.target);
    const far = back.length();
    const isChase = this.subject !== null && this.turning && far > NEAREST;
    const wanted = isChase ? Math.min(far, this.clearWay(back.clone().normalize(), far, nowMs)) : far;
    const share = this.still ? 1 : clamp((nowMs - this.drawnMs) / BACK_OFF_MS, 0, 1);
    const isEasing = isChase && this.drawn < wanted && share < 1;
    this.drawn = isEasing ? this.drawn + share * (wanted - this.drawn) : wanted;
    this.drawnMs = nowMs;
    if (this.drawn < far) this.camera.position.copy(this.controls.target).add(back.setLength(this.drawn));
    this.camera.updateMatrixWorld();
    return isEasing && wanted - this.drawn > 0.01;
  }

  private clearWay(direction: Vector3, far: number, nowMs: number): number {
    if (nowMs - this.looked >= LOOK_MS) {
      this.free = this.freeAlong(this.controls.target, direction, far);
      this.looked = nowMs;
    }
    return this.free > far ? far : Math.max(NEAREST, this.free - BEFORE_WALL);
  }

  private leaveEye(): void {
    const { beforeEye } = this;
    if (!beforeEye) return;
    this.beforeEye = this.eyeView = null;
    this.widen();
    this.controls.enabled = true;
    this.stand.position.copy(this.camera.position);
    this.stand.quaternion.copy(this.camera.quaternion);
    const ahead = new Vector3(0, 0, -AHEAD).applyQuaternion(this.camera.quaternion);
    this.controls.target.copy(this.camera.position).add(ahead);
    this.fly(beforeEye);
  }

  // Sets the field of view: that of the robot's camera in a robot's view, a narrow one in a map,
  // and FIELD_OF_VIEW_DEG otherwise.
  private widen(): void {
    const { camera, eyeView } = this;
    const ownFov = this.beforeMap ? MAP_FIELD_OF_VIEW_DEG : FIELD_OF_VIEW_DEG;
    this.stand.fov = ownFov;
    camera.fov = eyeView ? fieldOfViewDeg(eyeView, camera.aspect) : ownFov;
    for (const each of [this.stand, camera]) each.updateProjectionMatrix();
  }

  private setGestures(): void {
    const isMap = this.beforeMap !== null;
    this.controls.enableRotate = !isMap;
    this.controls.mouseButtons.LEFT = isMap ? MOUSE.PAN : MOUSE.ROTATE;
    this.controls.touches.ONE = isMap ? TOUCH.PAN : TOUCH.ROTATE;
  }

  private setDepth(near: number, far: number): void {
    for (const each of [this.stand, this.camera]) {
      if (each.near === near && each.far === far) continue;
      each.near = near;
      each.far = far;
      each.updateProjectionMatrix();
    }
  }

  private overhead(): Vector3 {
    const { position, target } = this.viewpoint;
    const back = steepened(position.sub(target));
    return back.setLength(Math.min(back.length(), FOLLOWING_DISTANCE));
  }

  private *points(): Generator<Vector3> {
    yield this.stand.position;
    yield this.controls.target;
    if (!this.flight) return;
    for (const { position, target } of [this.flight.from, this.flight.to]) {
      yield position;
      yield target;
    }
  }

  private lookAt(box: Box3, wanted: Vector3, fly: boolean): void {
    const direction = this.beforeMap ? DOWN : wanted;
    const target = box.getCenter(new Vector3());
    const distance = MARGIN * fittingDistance(this.camera, box, direction);
    const position = target.clone().addScaledVector(direction, -distance);
    this.controls.maxDistance = Math.min(Math.max(50, 6 * distance), FARTHEST_MAP);
    if (!this.beforeMap) {
      this.orbitDepth = { near: Math.min(0.1, distance / 100), far: 3 * this.controls.maxDistance };
      this.setDepth(this.orbitDepth.near, this.orbitDepth.far);
    }
    if (fly) this.fly({ position, target });
    else this.viewpoint = { position, target };
  }

  private fly(to: Viewpoint): void {
    const from = { position: this.stand.position.clone(), target: this.controls.target.clone() };
    this.flight = { from, to, startMs: this.still ? -Infinity : performance.now() };
    this.controls.dispatchEvent({ type: "change" });
  }

  private advanceFlight({ from, to, startMs }: Flight, nowMs: number): void {
    const share = Math.min(1, (nowMs - startMs) / FLIGHT_MS);
    const eased = share < 0.5 ? 4 * share ** 3 : 1 - (-2 * share + 2) ** 3 / 2;
    this.stand.position.lerpVectors(from.position, to.position, eased);
    this.controls.target.lerpVectors(from.target, to.target, eased);
    if (share >= 1) this.flight = null;
  }
}

// If the camera is too low for following a robot, raises it to the minimum height. The heading
// stays.
function steepened(back: Vector3): Vector3 {
  back.z = Math.max(back.z, FOLLOWING_STEEPNESS * Math.hypot(back.x, back.y));
  return back;
}

function behind(yaw: number): Vector3 {
  return new Vector3(-BEHIND * Math.cos(yaw), -BEHIND * Math.sin(yaw), ABOVE);
}
