// Moves bodies by hand in edit mode. Dragging a body moves it over the floor; dragging the tip of
// the selected body's arrow rotates it. All other gestures move the camera.
import type { Camera } from "three";
import { Matrix4, Plane, Vector3 } from "three";
import type { SceneBody } from "../api/scene";
import type { Placed } from "../api/scenario";
import type { BodyLayer } from "./BodyLayer";
import type { ScreenPlace } from "./picking";
import { rayThrough, screenPlaceOf } from "./picking";
import type { RobotPlaces } from "./RobotPlaces";
import { TurnHandle } from "./TurnHandle";

const TIP_PX = 14; // px: if a press is within this distance of the tip, it drags the arrow
const DRAG_PX = 5;

export interface ArrangerView {
  host: HTMLElement; // contains the canvas
  camera: Camera;
  bodies(): BodyLayer | null;
  robots(): RobotPlaces | null;
  selection(): string | null;
  isTaken(event: PointerEvent): boolean; // whether another control of the view handles this press
  redraw(): void;
}

export interface ArrangerEvents {
  onPick(body: string): void;
  // Resolves to true if the body has been moved to this place.
  onPlace(body: string, place: Placed): Promise<boolean>;
}

interface Drag {
  body: SceneBody;
  index: number;
  start: ScreenPlace;
  before: Matrix4; // world_from_body
  grip: Vector3; // the point on the floor at which the drag began
  turns: boolean;
  place: Placed;
  isMoved: boolean;
}

export class Arranger {
  readonly handle = new TurnHandle();
  isOn = false;
  hasArrow = true; // whether the arrow is shown
  private drag: Drag | null = null;
  private held: BodyLayer | null = null;

  constructor(
    private readonly view: ArrangerView,
    private readonly events: ArrangerEvents,
  ) {
    const { host } = view;
    // These listeners run in the capture phase. So they can stop an event before the camera's
    // gestures receive it.
    host.addEventListener("pointerdown", (event) => this.grab(event), true);
    host.addEventListener("pointermove", (event) => this.pull(event), true);
    host.addEventListener("pointerup", (event) => this.drop(event), true);
    host.addEventListener("pointercancel", () => this.giveUp(), true);
  }

  // Called with every frame.
  showHandle(): void {
    const robot = this.isOn && this.hasArrow ? this.view.selection() : null;
    const ring = robot === null ? null : this.view.robots()?.ringOf(robot);
    const subject = robot === null ? null : this.view.robots()?.subjectOf(robot);
    if (ring && subject) this.handle.show(ring.position, subject.yaw, ring.radius);
    else this.handle.hide();
  }

  // The place of the arrow's tip; null while the arrow is hidden.
  tipOnScreen(): ScreenPlace | null {
    const { tip } = this.handle;
    return tip && screenPlaceOf(tip, this.view.camera, this.view.host.getBoundingClientRect());
  }

  // Moves the selected body to this place.
  placeAt({ x, y }: { x: number; y: number }): void {
    const body = this.view.selection();
    const subject = body === null ? null : this.view.robots()?.subjectOf(body);
    if (body !== null && subject) void this.events.onPlace(body, { x, y, yaw: subject.yaw });
  }

  // Whether the displayed pose differs from the last reported pose, because the user is dragging
  // the body or has just released it.
  get holds(): boolean {
    return this.held !== null && this.held === this.view.bodies();
  }

  private grab(event: PointerEvent): void {
    if (!this.isOn || this.holds || !event.isPrimary || event.button !== 0) return;
    if (!(event.target instanceof HTMLCanvasElement) || this.view.isTaken(event)) return;
    const start = { x: event.clientX, y: event.clientY };
    const turns = this.isAtTip(start);
    const bodies = this.view.bodies();
    const body = turns ? this.selected() : (bodies?.pick(this.ray(start)) ?? null);
    const index = body && bodies ? bodies.indexOf(body.name) : -1;
    const before = bodies?.poseOf(index)?.clone();
    // A static body that a user has added can be dragged only after it has been selected. A static
    // body of the world file (isFixed) cannot be dragged.
    if (!body || !before || body.isFixed || (body.isStatic && body.name !== this.view.selection())) return;
    const grip = this.onPlane(start, before.elements[14]!);
    if (!grip) return;
    event.stopPropagation();
    this.view.host.setPointerCapture(event.pointerId);
    this.drag = { body, index, start, before, grip, turns, place: placeOf(before), isMoved: false };
  }

  private pull(event: PointerEvent): void {
    const { drag } = this;
    const bodies = this.view.bodies();
    if (!drag || !bodies || !event.isPrimary) return;
    event.stopPropagation();
    const at = { x: event.clientX, y: event.clientY };
    drag.isMoved ||= Math.hypot(at.x - drag.start.x, at.y - drag.start.y) > DRAG_PX;
    const point = this.onPlane(at, drag.before.elements[14]!);
    if (!drag.isMoved || !point) return;
    this.held = bodies;
    drag.place = drag.turns ? turned(drag.before, point) : shifted(drag.before, drag.grip, point);
    bodies.moveBody(drag.index, atPlace(drag.before, drag.place));
    this.view.redraw();
  }

  private drop(event: PointerEvent): void {
    const { drag } = this;
    this.drag = null;
    if (!drag) return;
    event.stopPropagation();
    const { name } = drag.body;
    if (!drag.isMoved) {
      // A click on the arrow selects the body behind the tip of the arrow, if there is one.
      const behind = drag.turns ? this.view.bodies()?.pick(this.ray(drag.start)) : null;
      return this.events.onPick(behind && !behind.isFixed ? behind.name : name);
    }
    void this.events.onPlace(name, drag.place).then((stands) => stands || this.giveUp());
  }

  // The body returns to its last reported pose.
  private giveUp(): void {
    this.drag = null;
    this.held = null;
    this.view.redraw();
  }

  private selected(): SceneBody | null {
    const bodies = this.view.bodies();
    const index = bodies?.indexOf(this.view.selection() ?? "") ?? -1;
    return bodies?.scene.bodies[index] ?? null;
  }

  private isAtTip(at: ScreenPlace): boolean {
    const place = this.tipOnScreen();
    return place !== null && Math.hypot(at.x - place.x, at.y - place.y) <= TIP_PX;
  }

  private ray(at: ScreenPlace) {
    return rayThrough(at, this.view.host.getBoundingClientRect(), this.view.camera);
  }

  // Returns the place on a fixed body under the pointer. If there is none, returns the place on the
  // floor.
  floorAt(at: ScreenPlace): Vector3 | null {
    return this.view.bodies()?.pointOf(this.ray(at)) ?? this.onPlane(at, 0);
  }

  private onPlane(at: ScreenPlace, height: number): Vector3 | null {
    const plane = new Plane(new Vector3(0, 0, 1), -height);
    return this.ray(at).ray.intersectPlane(plane, new Vector3());
  }
}

function placeOf({ elements: e }: Matrix4): Placed {
  return { x: e[12]!, y: e[13]!, yaw: Math.atan2(e[1]!, e[0]!) };
}

function shifted(before: Matrix4, grip: Vector3, point: Vector3): Placed {
  const { x, y, yaw } = placeOf(before);
  return { x: x + point.x - grip.x, y: y + point.y - grip.y, yaw };
}

function turned(before: Matrix4, point: Vector3): Placed {
  const { x, y } = placeOf(before);
  return { x, y, yaw: Math.atan2(point.y - y, point.x - x) };
}

// Returns world_from_body at that place, with the height and tilt of `before`.
function atPlace(before: Matrix4, { x, y, yaw }: Placed): Matrix4 {
  const turn = new Matrix4().makeRotationZ(yaw - placeOf(before).yaw);
  return turn.multiply(before).setPosition(x, y, before.elements[14]!);
}
