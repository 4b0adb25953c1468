// The handles that move and rotate the selected bodies. They are three's TransformControls,
// attached to a separate frame. The bodies follow this frame.
import type { BufferAttribute, BufferGeometry, Camera } from "three";
import { Box3, Group, Matrix4, Mesh, Object3D, Vector3 } from "three";
import type { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { GizmoTool } from "../state/editing";
import type { ScreenPlace } from "./picking";
import { screenPlaceOf } from "./picking";

const SIZE = 0.85; // as a fraction of three's default
const AXES: Readonly<Record<string, number>> = { X: 0, Y: 1, Z: 2 };
// These handles are left out, because they cover the body. A drag on the body moves it over the
// floor.
const LEFT_OUT: ReadonlySet<string> = new Set(["XYZ", "XZ", "YZ"]);
const HANDLE_SHARE = 0.5; // fraction of an arrow's length at which tests drag it

export interface GizmoEvents {
  onGrab(): void;
  // Called with the motion of the frame in the world since the drag began.
  onMove(motion: Matrix4): void;
  onDrop(): void;
}

// Whether a part is an arrow that points against the direction of its axis.
function isBackArrow(part: Object3D): boolean {
  const axis = AXES[part.name];
  if (axis === undefined || !(part instanceof Mesh)) return false;
  const bounds = new Box3().setFromBufferAttribute((part.geometry as BufferGeometry).getAttribute("position") as BufferAttribute);
  return bounds.min.getComponent(axis) < -0.1 && bounds.max.getComponent(axis) < 0.05;
}

export class Gizmo {
  readonly root = new Group();
  private readonly controls: TransformControls;
  private readonly frame = new Object3D();
  private readonly before = new Matrix4(); // world_from_frame when the drag began
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
    const helper = this.controls.getHelper();
    const leftOut: Object3D[] = [];
    helper.traverse((part) => (LEFT_OUT.has(part.name) || isBackArrow(part)) && leftOut.push(part));
    for (const part of leftOut) part.removeFromParent();
    this.root.add(this.frame, helper);
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
    // The gestures of the camera are off while the user drags a handle.
    let wasEnabled = true;
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      if (value) wasEnabled = orbit.enabled;
      orbit.enabled = value ? false : wasEnabled;
    });
  }

  get isDragging(): boolean {
    return this.controls.dragging;
  }

  // `isUpright`: the body stays upright on the floor, as robots do.
  setTool(tool: GizmoTool, isUpright: boolean): void {
    this.tool = tool;
    this.isUpright = isUpright;
    this.controls.setMode(tool.mode === "turn" ? "rotate" : "translate");
    // A rotation is about the body's own axes. A motion is along the axes of the world, because the
    // page shows coordinates in the world.
    this.controls.setSpace(tool.mode === "turn" ? "local" : "world");
    this.controls.setTranslationSnap(tool.snaps ? tool.distance : null);
    this.controls.setRotationSnap(tool.snaps ? (tool.angleDeg * Math.PI) / 180 : null);
    const isTurn = tool.mode === "turn";
    this.controls.showX = this.controls.showY = !(isUpright && isTurn);
    this.controls.showZ = isUpright ? isTurn : true;
  }

  // Puts the handles at a body's pose; null: there is no body to move.
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

  // Whether a press at this place is on a handle.
  isAt({ x, y }: ScreenPlace): boolean {
    if (!this.controls.object || !this.controls.enabled) return false;
    const frame = this.host.getBoundingClientRect();
    const pointer = { x: (2 * (x - frame.left)) / frame.width - 1, y: 1 - (2 * (y - frame.top)) / frame.height, button: 0 };
    this.root.updateMatrixWorld(true);
    this.controls.pointerHover(pointer as unknown as PointerEvent);
    return this.controls.axis !== null;
  }

  // Returns the place on the page where the handle of a world axis is drawn; null while the handle
  // is hidden.
  handleAt(axis: "x" | "y" | "z"): ScreenPlace | null {
    if (!this.controls.object) return null;
    const origin = this.frame.getWorldPosition(new Vector3());
    // TransformControlsGizmo draws its handles with this scale for a perspective camera.
    const distance = origin.distanceTo(this.camera.getWorldPosition(new Vector3()));
    const { fov, zoom } = this.camera as unknown as { fov: number; zoom: number };
    const scale = (distance * Math.min((1.9 * Math.tan((Math.PI * fov) / 360)) / zoom, 7) * SIZE) / 4;
    const along = new Vector3(Number(axis === "x"), Number(axis === "y"), Number(axis === "z"));
    return screenPlaceOf(origin.addScaledVector(along, HANDLE_SHARE * scale), this.camera, this.host.getBoundingClientRect());
  }
}
