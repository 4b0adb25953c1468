// The handles by which the chosen bodies are moved and turned: three's TransformControls, on a frame of
// their own that the bodies follow.
import type { Camera } from "three";
import { Group, Matrix4, Object3D, Vector3 } from "three";
import type { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { GizmoTool } from "../state/editing";
import type { ScreenPlace } from "./picking";
import { screenPlaceOf } from "./picking";

const SIZE = 0.85; // of three's own
const HANDLE_SHARE = 0.5; // of the length of an arrow, where it is taken hold of in tests

export interface GizmoEvents {
  onGrab(): void;
  // The frame has moved by this, in the world, since it was taken hold of.
  onMove(motion: Matrix4): void;
  onDrop(): void;
}

export class Gizmo {
  readonly root = new Group();
  private readonly controls: TransformControls;
  private readonly frame = new Object3D();
  private readonly before = new Matrix4(); // world_from_frame when it was taken hold of
  private tool: GizmoTool | null = null;
  private isUpright = false;

  constructor(
    private readonly host: HTMLElement,
    private readonly camera: Camera,
    canvas: HTMLElement,
    orbit: OrbitControls,
    events: GizmoEvents,
    redraw: () => void,
  ) {
    this.controls = new TransformControls(camera, canvas);
    this.controls.size = SIZE;
    this.root.add(this.frame, this.controls.getHelper());
    this.controls.addEventListener("change", redraw);
    this.controls.addEventListener("mouseDown", () => {
      this.frame.updateMatrixWorld(true);
      this.before.copy(this.frame.matrixWorld);
      events.onGrab();
    });
    this.controls.addEventListener("objectChange", () => {
      this.frame.updateMatrixWorld(true);
      events.onMove(this.frame.matrixWorld.clone().multiply(this.before.clone().invert()));
    });
    this.controls.addEventListener("mouseUp", () => events.onDrop());
    // The view's own gestures wait while a handle is held.
    let wasEnabled = true;
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      if (value) wasEnabled = orbit.enabled;
      orbit.enabled = value ? false : wasEnabled;
    });
  }

  get isDragging(): boolean {
    return this.controls.dragging;
  }

  // `isUpright`: it can only stand on the floor, as robots do.
  setTool(tool: GizmoTool, isUpright: boolean): void {
    this.tool = tool;
    this.isUpright = isUpright;
    this.controls.setMode(tool.mode === "turn" ? "rotate" : "translate");
    // Turned about its own axes; moved along the world's, whose numbers are shown.
    this.controls.setSpace(tool.mode === "turn" ? "local" : "world");
    this.controls.setTranslationSnap(tool.snaps ? tool.distance : null);
    this.controls.setRotationSnap(tool.snaps ? (tool.angleDeg * Math.PI) / 180 : null);
    const isTurn = tool.mode === "turn";
    this.controls.showX = this.controls.showY = !(isUpright && isTurn);
    this.controls.showZ = isUpright ? isTurn : true;
  }

  // At a body's pose; null: there is none to be moved.
  attach(worldFromBody: Matrix4 | null): void {
    if (this.isDragging) return;
    if (!worldFromBody || !this.tool) return void this.controls.detach();
    worldFromBody.decompose(this.frame.position, this.frame.quaternion, this.frame.scale);
    this.frame.updateMatrixWorld(true);
    if (this.controls.object !== this.frame) {
      this.controls.attach(this.frame);
      this.setTool(this.tool, this.isUpright);
    }
  }

  // Whether a press there takes hold of a handle.
  isAt({ x, y }: ScreenPlace): boolean {
    if (!this.controls.object || !this.controls.enabled) return false;
    const frame = this.host.getBoundingClientRect();
    const pointer = { x: (2 * (x - frame.left)) / frame.width - 1, y: 1 - (2 * (y - frame.top)) / frame.height, button: 0 };
    this.root.updateMatrixWorld(true);
    this.controls.pointerHover(pointer as unknown as PointerEvent);
    return this.controls.axis !== null;
  }

  // Where the handle of an axis of the world is drawn, on the page; null while it is hidden.
  handleAt(axis: "x" | "y" | "z"): ScreenPlace | null {
    if (!this.controls.object) return null;
    const origin = this.frame.getWorldPosition(new Vector3());
    // As TransformControlsGizmo scales itself, with a perspective camera.
    const distance = origin.distanceTo(this.camera.getWorldPosition(new Vector3()));
    const { fov, zoom } = this.camera as unknown as { fov: number; zoom: number };
    const scale = (distance * Math.min((1.9 * Math.tan((Math.PI * fov) / 360)) / zoom, 7) * SIZE) / 4;
    const along = new Vector3(Number(axis === "x"), Number(axis === "y"), Number(axis === "z"));
    return screenPlaceOf(origin.addScaledVector(along, HANDLE_SHARE * scale), this.camera, this.host.getBoundingClientRect());
  }
}
