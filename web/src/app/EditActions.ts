// The actions that edit the selected bodies. The bodies are in a simulation (EditControl) or in the
// form for a new simulation (SetUpControl).
import type { BodyPlace, SetUpApi } from "../api/SetUpApi";
import type { Placed } from "../api/scenario";
import { findRobot } from "../api/scenario";
import { allChosen } from "../state/editing";
import type { Shape } from "../state/shapes";
import { footprintOf, modelOf } from "../state/shapes";
import type { BodyPose, State } from "../state/State";
import type { Store } from "../state/Store";
import { download } from "../ui/files";
import type { EditControl } from "./EditControl";
import { notify } from "./notices";
import type { SetUpControl } from "./SetUpControl";

const BEFORE_ROBOT_M = 0.6; // distance between a robot's origin and a shape that is added in front of it

export class EditActions {
  constructor(
    private readonly store: Store<State>,
    private readonly api: SetUpApi,
    private readonly edits: EditControl,
    private readonly setUp: SetUpControl,
    private readonly placeOf: (body: string) => Required<BodyPlace> | null, // null if the place is unknown
    // The point at which the camera looks, in metres in the world; null if there is no view.
    private readonly lookedAt: () => { x: number; y: number } | null,
  ) {}

  // Moves a body to the pose to which the user dragged it. Resolves to true if the body is now
  // there.
  place(body: string, place: Placed): Promise<boolean> {
    this.store.set({ placing: false });
    return this.store.get().setUp ? this.setUp.place(body, place) : this.edits.place(body, place);
  }

  // Moves bodies to the poses that the gizmo or typed numbers specify.
  pose(poses: readonly BodyPose[]): Promise<boolean> {
    const posed = poses.map(({ body, ...place }) => ({ body, place }));
    const [first] = posed;
    if (!this.store.get().setUp) return this.edits.pose(posed);
    return first ? this.setUp.place(first.body, first.place) : Promise.resolve(false);
  }

  // Adds a shape at the given position. Without a position, adds it in front of the selected robot, or
  // at the point at which the camera looks if no robot is selected. The server refuses a place that
  // is occupied.
  async addShape(shape: Shape, at: { x: number | null; y: number | null } = { x: null, y: null }): Promise<boolean> {
    const { selection, editing } = this.store.get();
    const robot = editing?.chosen == null && selection !== null ? this.placeOf(selection) : null;
    const ahead = BEFORE_ROBOT_M + footprintOf(shape);
    const centre = this.lookedAt();
    const automatic = robot
      ? { x: robot.x + ahead * Math.cos(robot.yaw), y: robot.y + ahead * Math.sin(robot.yaw), yaw: robot.yaw }
      : centre && { ...centre, yaw: 0 };
    const place = at.x !== null && at.y !== null ? { x: at.x, y: at.y, yaw: 0 } : automatic;
    return this.edits.addObject({ name: "", model: modelOf(shape), place }, shape.kind);
  }

  copy(): void {
    const count = this.edits.copy(allChosen(this.store.get()));
    if (count > 0) notify(this.store, "note", count === 1 ? "1 body copied." : `${count} bodies copied.`);
  }

  paste(): void {
    void this.edits.paste();
  }

  duplicate(): void {
    if (this.edits.copy(allChosen(this.store.get())) > 0) void this.edits.paste();
  }

  // Downloads the present state of the world. If `scenario` is true, also downloads a scenario file
  // for it.
  async saveWorld(scenario: boolean): Promise<void> {
    const { simulation } = this.store.get();
    if (!simulation) return;
    const file = worldFileName(simulation);
    try {
      const saved = await this.api.saveWorld(simulation, file);
      download(file, new Blob([saved.sdf], { type: "application/xml" }));
      if (scenario) download(file.replace(/\.sdf$/, ".yaml"), new Blob([saved.scenario], { type: "application/yaml" }));
      const what = scenario ? `${file} and its scenario` : file;
      notify(this.store, "note", `The browser has downloaded ${what}.`);
      for (const warning of saved.warnings) notify(this.store, "note", warning);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  remove(): void {
    const { setUp, selection, editing } = this.store.get();
    if (editing && editing.more.length > 0) return void this.edits.removeAll(allChosen(this.store.get()));
    if (editing?.chosen) return void this.edits.removeObject(editing.chosen);
    if (selection === null) return;
    const found = setUp && findRobot(setUp.scenario, selection);
    if (found) this.setUp.removeRobot(found.list, found.index);
    else if (!setUp) void this.edits.remove(selection);
  }

  // Rotates all selected bodies counter-clockwise, in radians. Only in edit mode.
  turn(angle: number): void {
    const state = this.store.get();
    if (state.editing) void this.edits.turn(allChosen(state), angle);
  }

  undo(): void {
    if (this.store.get().setUp) this.setUp.undo();
    else void this.edits.undo();
  }

  redo(): void {
    if (this.store.get().setUp) this.setUp.redo();
    else void this.edits.redo();
  }
}

// The name of a simulation as a file name.
function worldFileName(simulation: string): string {
  return `${simulation.replace(/[^\p{L}\p{N}_.-]+/gu, "_").slice(0, 80)}.sdf`;
}
