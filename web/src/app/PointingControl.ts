// Decides the effect of the next clicks in the view: move the selection, measure, or draw a wall.
import type { WallDrawing } from "../state/editing";
import { chosenOf } from "../state/editing";
import { faultOf, modelOf, wallBetween } from "../state/shapes";
import type { Point, State } from "../state/State";
import type { Store } from "../state/Store";
import type { EditControl } from "./EditControl";
import { notify } from "./notices";

export class PointingControl {
  constructor(
    private readonly store: Store<State>,
    private readonly edits: EditControl,
  ) {}

  // Whether the next click on the floor moves the selection there.
  setPlacing(placing: boolean): void {
    const { editing, setUp } = this.store.get();
    if (placing) this.end();
    this.store.set({ placing: placing && (editing !== null || setUp !== null) && chosenOf(this.store.get()) !== null });
  }

  // Draws a wall. The next two clicks on the floor are its ends.
  drawWall(wall: Omit<WallDrawing, "from"> | null): void {
    this.end();
    if (wall) this.edits.drawWall({ ...wall, from: null });
  }

  setMeasuring(isOn: boolean): void {
    this.end();
    this.store.set({ ruler: isOn ? [] : null });
  }

  // Receives a clicked point of the world for the ruler or a wall.
  takePoint(point: Point): void {
    const { ruler, editing } = this.store.get();
    if (ruler) this.store.set({ ruler: ruler.length < 2 ? [...ruler, point] : [point] });
    const wall = editing?.wall;
    if (!wall) return;
    if (!wall.from) return this.edits.drawWall({ ...wall, from: { x: point.x, y: point.y } });
    const { shape, place } = wallBetween(wall.from, point, wall);
    this.edits.drawWall(null);
    if (faultOf(shape) !== "") return notify(this.store, "error", "The ends of a wall must be at least 1 mm apart.");
    void this.edits.addObject({ name: "", model: modelOf(shape), place }, "wall");
  }

  // Cancels the pending use of the next click. Returns false if no use is pending.
  end(): boolean {
    const { placing, ruler, editing } = this.store.get();
    const wasOn = placing || ruler !== null || editing?.wall != null;
    if (!wasOn) return false;
    this.store.set({ placing: false, ruler: null });
    if (editing?.wall) this.edits.drawWall(null);
    return true;
  }
}
