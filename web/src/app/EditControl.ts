// Changes who stands in a simulation that stands still, with undo and redo. The server knows of no
// history: an edit is taken back by doing its opposite.
import type { BodyPlace, NewObject, SetUpApi } from "../api/SetUpApi";
import type { Placed, RobotSetUp } from "../api/scenario";
import type { Editing } from "../state/editing";
import { canEdit } from "../state/actions";
import { FIRST_EDITING } from "../state/editing";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { notify } from "./notices";

const MOST_EDITS = 100;
const STANDS_M = 1e-6; // who moved by less was turned

interface Edit {
  name: string; // "move pebble"
  apply(): Promise<void>;
  revert(): Promise<void>;
}

export interface Bodies {
  // Where a body was last reported; null while unknown.
  placeOf(body: string): (BodyPlace & { z: number }) | null;
}

export class EditControl {
  private done: Edit[] = []; // the newest last
  private takenBack: Edit[] = [];
  // What was put somewhere, until a scene shows it there.
  private unseen: { body: string; place: BodyPlace } | null = null;

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
    store.watch(
      ({ scene }) => scene,
      (scene) => {
        this.unseen = null;
        const chosen = this.store.get().editing?.chosen ?? null;
        if (chosen !== null && !scene?.bodies.some(({ name }) => name === chosen)) this.choose(null);
      },
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
      const { api } = this;
      const [models, objects, behaviours] = await Promise.all([
        api.models(),
        api.objectModels(),
        api.behaviours(),
      ]);
      this.patch({ models, objects, behaviours });
    });
  }

  // The object that edits are about from now on; null: the selected robot.
  choose(object: string | null): void {
    if (this.store.get().editing?.chosen !== object) this.patch({ chosen: object });
  }

  // Resolves to whether it stands there now.
  place(body: string, place: Placed): Promise<boolean> {
    const { simulation } = this.store.get();
    const before = this.placeOf(body);
    if (!simulation || !before) return Promise.resolve(false);
    const isTurn = Math.hypot(place.x - before.x, place.y - before.y) < STANDS_M;
    const wanted = this.isObject(body) ? asObject(place, before, isTurn) : place;
    return this.do({
      name: `${isTurn ? "turn" : "move"} ${body}`,
      apply: () => this.put(simulation, body, wanted),
      revert: () => this.put(simulation, body, before),
    });
  }

  // Counter-clockwise, in radians.
  turn(body: string, angle: number): Promise<boolean> {
    const before = this.placeOf(body);
    if (!before) return Promise.resolve(false);
    return this.place(body, { x: before.x, y: before.y, yaw: before.yaw + angle });
  }

  // What comes is chosen, so that it can be put where it belongs.
  async addObject(object: NewObject): Promise<boolean> {
    const { simulation } = this.store.get();
    if (!simulation) return false;
    let { name, place } = object;
    const isThere = await this.do({
      name: `add ${object.model ?? object.copy_of}`,
      apply: async () => {
        name = await this.api.addObject(simulation, { ...object, name, place });
      },
      revert: async () => {
        place = this.placeOf(name) ?? place; // it comes back where it stood
        await this.api.removeObject(simulation, name);
      },
    });
    if (isThere) this.choose(name);
    return isThere;
  }

  removeObject(object: string): Promise<boolean> {
    const { simulation } = this.store.get();
    const place = this.placeOf(object);
    if (!simulation || !place) return Promise.resolve(false);
    return this.do({
      name: `remove ${object}`,
      apply: () => this.api.removeObject(simulation, object),
      revert: async () => void (await this.api.addObject(simulation, { name: object, copy_of: object, place })),
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
        place = upright(this.placeOf(name)) ?? place; // it comes back where it stood
        await this.api.removeRobot(simulation, name);
      },
    });
  }

  // A robot that comes back has a new instance of its behaviour. One that came with the world needs no
  // model but its name.
  remove(robot: string): Promise<boolean> {
    const { simulation, status, scene } = this.store.get();
    const known = status?.robots.find(({ name }) => name === robot);
    const place = upright(this.placeOf(robot));
    if (!simulation || !known || !place) return Promise.resolve(false);
    const body = scene?.bodies.find(({ name }) => name === robot);
    const model = body?.isOfWorld ? "" : known.model;
    const again: RobotSetUp = { name: robot, model, place, behaviour: known.behaviour, constraint: "", movement: "", drive: "" };
    return this.do({
      name: `remove ${robot}`,
      apply: () => this.api.removeRobot(simulation, robot),
      revert: async () => void (await this.api.addRobot(simulation, again, body?.isAvatar === true)),
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

  private async put(simulation: string, body: string, place: BodyPlace): Promise<void> {
    await this.api.placeBody(simulation, body, place);
    this.unseen = { body, place };
  }

  private placeOf(body: string): (BodyPlace & { z: number }) | null {
    const seen = this.bodies.placeOf(body);
    return seen && this.unseen?.body === body ? { ...seen, ...this.unseen.place } : seen;
  }

  private isObject(body: string): boolean {
    const known = this.store.get().scene?.bodies.find(({ name }) => name === body);
    return known !== undefined && !known.isRobot && !known.isAvatar;
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

// A robot is put on its wheels, and its request knows of no other way.
function upright(place: (BodyPlace & { z: number }) | null) {
  return place && { x: place.x, y: place.y, z: place.z, yaw: place.yaw };
}

// An object lies as it lay; turned on the spot, it stays at its height, too.
function asObject(place: Placed, before: BodyPlace, isTurn: boolean): BodyPlace {
  const { roll = 0, pitch = 0, z } = before;
  return { ...place, roll, pitch, ...(isTurn && z !== undefined && { z }) };
}
