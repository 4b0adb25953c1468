// The tools that edit and measure in the view: the gizmo on the selected bodies, rings around them,
// the rectangle that selects several bodies, and the clicked points of a ruler or a wall.
import type { Camera, Matrix4, Vector3 } from "three";
import { Group, Matrix4 as Matrix } from "three";
import type { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { GizmoTool } from "../state/editing";
import type { BodyPose, Point } from "../state/State";
import type { BodyLayer } from "./BodyLayer";
import { Gizmo } from "./Gizmo";
import { SelectionRing } from "./Ground";
import type { ScreenPlace } from "./picking";
import { screenPlaceOf } from "./picking";
import { PointMarks } from "./PointMarks";
import { RectangleChoice } from "./RectangleChoice";
import type { RobotPlaces } from "./RobotPlaces";
import { poseOf } from "./poses";

// The effect of a click: it selects a body, moves the selection to this place, or provides a point.
export type ClickUse = "choose" | "place" | "point";

export interface EditToolsView {
  host: HTMLElement;
  canvas: HTMLElement;
  camera: Camera;
  orbit: OrbitControls;
  bodies(): BodyLayer | null;
  robots(): RobotPlaces | null;
  bodyAt(at: ScreenPlace): string | null;
  pointAt(at: ScreenPlace): Vector3 | null;
  redraw(): void;
}

export interface EditToolsEvents {
  onAddToChoice(body: string): void;
  onChoose(bodies: readonly string[]): void;
  onPoint(point: Point): void;
  onPlacePoint(point: Point): void;
  // Called with the pose of the first selected body while it is dragged.
  onDrag(pose: BodyPose): void;
  // Called with the new poses of the dragged bodies when the user releases them. Must resolve to
  // true if all bodies have these poses now. Otherwise the bodies return to their poses before the
  // drag.
  onPose(poses: readonly BodyPose[]): Promise<boolean>;
}

export class EditTools {
  readonly group = new Group();
  readonly gizmo: Gizmo;
  readonly marks = new PointMarks();
  private use: ClickUse = "choose";
  private readonly rings = new Group();
  private readonly ringsMade: SelectionRing[] = [];
  private readonly rectangle: RectangleChoice;
  private tool: GizmoTool | null = null; // null: edit mode is off
  private chosen: readonly string[] = [];
  private held: BodyLayer | null = null;
  // The poses of the dragged bodies before the drag.
  private before: { index: number; pose: Matrix4 }[] = [];
  private isMoved = false; // whether the drag has moved the bodies

  constructor(
    private readonly view: EditToolsView,
    private readonly events: EditToolsEvents,
  ) {
    const moving = { onGrab: () => this.grab(), onMove: (motion: Matrix4) => this.move(motion), onDrop: () => this.drop() };
    this.gizmo = new Gizmo(view.host, view.camera, view.canvas, view.orbit, moving, () => view.redraw());
    this.rectangle = new RectangleChoice(view.host, {
      onAdd: (at) => this.addToChoice(at),
      onChoose: (isInside) => this.chooseInside(isInside),
    });
    this.group.add(this.rings, this.marks.group, this.gizmo.root);
  }

  get clickUse(): ClickUse {
    return this.use;
  }

  // If clicks do not select bodies, the gizmo is hidden, because its handles would receive the
  // clicks.
  set clickUse(use: ClickUse) {
    this.use = use;
    this.show();
    this.view.redraw();
  }

  // Sets the mode of the gizmo. Null means that edit mode is off.
  setTool(tool: GizmoTool | null): void {
    this.tool = tool;
    this.rectangle.isOn = tool !== null;
    this.refresh();
  }

  // Selects the bodies. The gizmo is at the first body.
  choose(chosen: readonly string[]): void {
    this.chosen = chosen;
    this.refresh();
  }

  // Whether the displayed pose differs from the last reported pose, because the user is dragging
  // the body or has just released it.
  get holds(): boolean {
    return this.held !== null && this.held === this.view.bodies();
  }

  // Called with every frame.
  show(): void {
    this.gizmo.attach(this.tool && this.use === "choose" ? this.poseOf(this.chosen[0]) : null);
    const others = this.chosen.slice(1).flatMap((name) => this.view.robots()?.ringOf(name) ?? []);
    while (this.rings.children.length > others.length) this.rings.remove(this.rings.children.at(-1)!);
    others.forEach((place, i) => {
      const ring = this.ringAt(i);
      ring.place(place.position, place.radius);
    });
  }

  // Whether a press at this place is on a handle of the gizmo.
  isHandleAt(at: ScreenPlace): boolean {
    return this.tool !== null && this.use === "choose" && this.gizmo.isAt(at);
  }

  // Handles a click if it moves the selection or provides a point. Returns false if clicks select
  // bodies.
  click(at: ScreenPlace): boolean {
    if (this.use === "choose") return false;
    const point = this.view.pointAt(at);
    if (point) (this.use === "place" ? this.events.onPlacePoint : this.events.onPoint)({ x: point.x, y: point.y, z: point.z });
    return true;
  }

  private ringAt(index: number): SelectionRing {
    const ring = (this.ringsMade[index] ??= new SelectionRing());
    if (ring.mesh.parent !== this.rings) this.rings.add(ring.mesh);
    return ring;
  }

  private refresh(): void {
    const first = this.view.bodies()?.scene.bodies.find(({ name }) => name === this.chosen[0]);
    if (this.tool) this.gizmo.setTool(this.tool, first !== undefined && (first.isRobot || first.isAvatar));
    this.view.redraw();
  }

  private poseOf(body: string | undefined): Matrix4 | null {
    const bodies = this.view.bodies();
    return body === undefined || !bodies ? null : bodies.poseOf(bodies.indexOf(body));
  }

  private grab(): void {
    const bodies = this.view.bodies();
    this.held = bodies;
    this.isMoved = false;
    this.before = this.chosen.flatMap((name) => {
      const index = bodies?.indexOf(name) ?? -1;
      const pose = bodies?.poseOf(index)?.clone();
      return pose ? [{ index, pose }] : [];
    });
  }

  private move(motion: Matrix4): void {
    const bodies = this.view.bodies();
    if (!bodies || this.held !== bodies) return;
    this.isMoved = true;
    for (const { index, pose } of this.before) bodies.moveBody(index, motion.clone().multiply(pose));
    const [first] = this.poses(bodies);
    if (first) this.events.onDrag(first);
    this.view.redraw();
  }

  private drop(): void {
    const bodies = this.view.bodies();
    if (!bodies || this.held !== bodies) return;
    if (!this.isMoved) this.held = null; // a click on a handle is no edit
    else void this.events.onPose(this.poses(bodies)).then((stand) => stand || this.giveUp());
  }

  // Returns the bodies to their last reported poses.
  private giveUp(): void {
    const bodies = this.view.bodies();
    if (bodies && this.held === bodies) {
      for (const { index, pose } of this.before) bodies.moveBody(index, pose);
      const [first] = this.poses(bodies);
      if (first) this.events.onDrag(first); // the fields show the old pose again
    }
    this.held = null;
    this.view.redraw();
  }

  private poses(bodies: BodyLayer): BodyPose[] {
    return this.before.map(({ index }) => ({
      body: bodies.scene.bodies[index]!.name,
      ...poseOf(bodies.poseOf(index) ?? new Matrix()),
    }));
  }

  private addToChoice(at: ScreenPlace): void {
    const body = this.view.bodyAt(at);
    if (body !== null) this.events.onAddToChoice(body);
  }

  private chooseInside(isInside: (at: ScreenPlace) => boolean): void {
    const bodies = this.view.bodies();
    const robots = this.view.robots();
    if (!bodies || !robots) return;
    const frame = this.view.host.getBoundingClientRect();
    const names = bodies.scene.bodies.flatMap(({ name, isFixed }) => {
      const middle = isFixed ? null : robots.middleOf(name);
      const at = middle && screenPlaceOf(middle, this.view.camera, frame);
      return at && isInside(at) ? [name] : [];
    });
    this.events.onChoose(names);
  }
}
