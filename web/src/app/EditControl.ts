// Changes who stands in a simulation that stands still, with undo and redo. The server knows of no
// history: an edit is taken back by doing its opposite.
import type { BodyPlace, SetUpApi } from "../api/SetUpApi";
import type { Placed, RobotSetUp } from "../state/scenario";
import type { Editing } from "../state/editing";
import { FIRST_EDITING, canEdit } from "../state/editing";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { notify } from "./notices";

const MOST_EDITS = 100;

interface Edit {
  name: string; // "move pebble"
  apply(): Promise<void>;
  revert(): Promise<void>;
}

export interface Bodies {
  // Where a body was last reported; null while unknown.
  placeOf(body: string): Required<BodyPlace> | null;
}

export class EditControl {
  private done: Edit[] = []; // the newest last
  private takenBack: Edit[] = [];

  constructor(
    private readonly store: Store<State>,
    private readonly api: SetUpApi,
    private readonly bodies: Bodies,
    private readonly pause: () => Promise<void>,
  ) {
    // It ends when the simulation goes on, or another one is watched.
    store.watch(
      ({ status, simulation }) => `${status?.phase === "paused" || status?.phase === "created"} ${simulation}`,
      () => this.store.get().editing && this.end(),
    );
  }

  async toggle(): Promise<void> {
    if (this.store.get().editing) return this.end();
    if (!canEdit(this.store.get())) return;
    if (this.store.get().status?.phase === "running") await this.pause();
    await this.standsStill();
    this.done = [];
    this.takenBack = [];
    this.store.set({ editing: FIRST_EDITING });
    await this.ask(async () => {
      const [models, behaviours] = await Promise.all([this.api.models(), this.api.behaviours()]);
      this.patch({ models, behaviours });
    });
  }

  // Resolves to whether it stands there now.
  place(body: string, place: Placed): Promise<boolean> {
    const { simulation } = this.store.get();
    const before = this.bodies.placeOf(body);
    if (!simulation || !before) return Promise.resolve(false);
    return this.do({
      name: `move ${body}`,
      apply: () => this.api.placeBody(simulation, body, place),
      revert: () => this.api.placeBody(simulation, body, before),
    });
  }

  add(robot: RobotSetUp, isAvatar: boolean): Promise<boolean> {
    const { simulation } = this.store.get();
    if (!simulation) return Promise.resolve(false);
    let { name, place } = robot;
    return this.do({
      name: `add ${robot.model}`,
      apply: async () => {
        name = await this.api.addRobot(simulation, { ...robot, name, place }, isAvatar);
      },
      revert: async () => {
        place = this.bodies.placeOf(name) ?? place; // it comes back where it stood
        await this.api.removeRobot(simulation, name);
      },
    });
  }

  // A robot that comes back has a new instance of its behaviour.
  remove(robot: string): Promise<boolean> {
    const { simulation, status, scene } = this.store.get();
    const known = status?.robots.find(({ name }) => name === robot);
    const place = this.bodies.placeOf(robot);
    if (!simulation || !known || !place) return Promise.resolve(false);
    const { model, behaviour } = known;
    const isAvatar = scene?.bodies.some(({ name, isAvatar }) => name === robot && isAvatar) === true;
    const again: RobotSetUp = { name: robot, model, place, behaviour, constraint: "", movement: "" };
    return this.do({
      name: `remove ${robot}`,
      apply: () => this.api.removeRobot(simulation, robot),
      revert: async () => void (await this.api.addRobot(simulation, again, isAvatar)),
    });
  }

  async undo(): Promise<void> {
    const edit = this.done.at(-1);
    if (!edit || !(await this.ask(() => edit.revert()))) return;
    this.done.pop();
    this.takenBack.push(edit);
    this.tell();
  }

  async redo(): Promise<void> {
    const edit = this.takenBack.at(-1);
    if (!edit || !(await this.ask(() => edit.apply()))) return;
    this.takenBack.pop();
    this.done.push(edit);
    this.tell();
  }

  private async do(edit: Edit): Promise<boolean> {
    if (!(await this.ask(() => edit.apply()))) return false;
    this.done = [...this.done, edit].slice(-MOST_EDITS);
    this.takenBack = [];
    this.tell();
    return true;
  }

  // The stream tells that it is paused, some time after the server has answered.
  private standsStill(): Promise<void> {
    return new Promise((resolve) => {
      const unwatch = this.store.watch(
        ({ status, simulation }) => status?.phase !== "running" || simulation === null,
        (stands) => stands && queueMicrotask(() => (unwatch(), resolve())),
      );
    });
  }

  private end(): void {
    this.store.set({ editing: null });
  }

  private tell(): void {
    this.patch({ undo: this.done.map(({ name }) => name), redo: this.takenBack.map(({ name }) => name) });
  }

  private patch(change: Partial<Editing>): void {
    this.store.set(({ editing }) => (editing ? { editing: { ...editing, ...change } } : {}));
  }

  // One edit at a time. False: another is under way, or the server refused, and says why.
  private async ask(work: () => Promise<void>): Promise<boolean> {
    if (!this.store.get().editing || this.store.get().editing?.isBusy) return false;
    this.patch({ isBusy: true });
    try {
      await work();
      return true;
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
      return false;
    } finally {
      this.patch({ isBusy: false });
    }
  }
}
