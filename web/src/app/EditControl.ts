// Edits the bodies of a paused simulation, with undo and redo. The server stores no history, so
// undo performs the opposite edit.
import type { BodyPlace, NewObject, SetUpApi } from "../api/SetUpApi";
import type { Placed, RobotSetUp } from "../api/scenario";
import type { Editing, GizmoTool } from "../state/editing";
import { canEdit } from "../state/actions";
import { FIRST_EDITING } from "../state/editing";
import { bodyPart } from "../state/parts";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import type { Edit } from "./edits";
import { inOrder, together } from "./edits";
import { notify, offer } from "./notices";
import type { RobotChoices } from "./robotChoices";
import { readRobotChoices } from "./robotChoices";

const MOST_EDITS = 100;
const STANDS_M = 1e-6; // an edit that moves a body by less than this only rotates it
const SHOWN_WITHIN_MS = 10_000;
const SHOWN_POLL_MS = 20;
const LONGEST_PAUSE_MS = 10_000;
const NO_CHOICES: RobotChoices = new Map();
const PASTED_AT_M = 0.5; // offset of a pasted copy from the original, along x and along y

// Provides the reported poses of bodies.
export interface Bodies {
  // Returns the last reported pose of a body; null while it is unknown.
  placeOf(body: string): Required<BodyPlace> | null;
}

// A body and its new pose.
export interface Posed {
  body: string;
  place: BodyPlace;
}

interface Copied {
  body: string;
  robot: RobotSetUp | null; // null for an object
  isAvatar: boolean;
  place: BodyPlace;
}

export class EditControl {
  private done: Edit[] = []; // edits that can be undone; the newest is last
  private takenBack: Edit[] = [];
  private hasPaused = false; // whether editing paused the simulation
  // The robot that was selected when an object was added. When the object is no longer selected,
  // this robot is selected again.
  private robotBefore: string | null = null;
  // Poses that were set here, but that no received scene contains yet.
  private readonly unseen = new Map<string, BodyPlace>();
  private copied: Copied[] = [];
  private copiedChoices: Promise<RobotChoices> = Promise.resolve(NO_CHOICES);
  private pastes = 0; // how many times the copied bodies were pasted

  constructor(
    private readonly store: Store<State>,
    private readonly api: SetUpApi,
    private readonly bodies: Bodies,
    private readonly pause: () => Promise<void>,
    private readonly resume: () => void,
  ) {
    // Editing ends if the simulation resumes, or if the page shows another simulation.
    store.watch(
      ({ status, simulation }) => `${status?.phase === "paused" || status?.phase === "created"} ${simulation}`,
      () => this.store.get().editing && this.end(),
    );
    store.watch(
      ({ scene }) => scene,
      () => {
        this.unseen.clear();
        const { editing } = this.store.get();
        if (!editing) return;
        const isThere = (body: string) => this.isInScene(body);
        if (editing.chosen !== null && !isThere(editing.chosen)) this.selectRobotBefore();
        else if (!editing.more.every(isThere)) this.patch({ more: editing.more.filter(isThere) });
      },
    );
  }

  async toggle(): Promise<void> {
    if (this.store.get().editing) {
      this.end();
      return this.offerToResume();
    }
    if (!canEdit(this.store.get())) return;
    const { simulation } = this.store.get();
    this.hasPaused = this.store.get().status?.phase === "running";
    if (this.hasPaused) await this.pause();
    if (!(await this.standsStill())) return notify(this.store, "error", "The simulation still runs. Pause it to edit it.");
    const now = this.store.get();
    if (now.editing || now.simulation !== simulation || !canEdit(now)) return;
    this.done = [];
    this.takenBack = [];
    this.copied = [];
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

  // Selects the object that further edits change; null means the selected robot. Deselects all
  // other bodies.
  choose(object: string | null): void {
    const { editing } = this.store.get();
    if (!editing) return;
    this.robotBefore = null;
    if (editing.chosen !== object || editing.more.length > 0) this.patch({ chosen: object, more: [] });
    if (object !== null) this.store.set({ selection: null, selectedPose: null });
  }

  // Sets the selected bodies other than the first one.
  chooseMore(more: readonly string[]): void {
    this.patch({ more });
  }

  setTool(change: Partial<GizmoTool>): void {
    const { editing } = this.store.get();
    if (editing) this.patch({ tool: { ...editing.tool, ...change } });
  }

  drawWall(wall: Editing["wall"]): void {
    this.patch({ wall });
  }

  // Moves a body. Resolves to true if the body is now there.
  place(body: string, place: Placed): Promise<boolean> {
    const before = this.placeOf(body);
    if (!before) return Promise.resolve(false);
    const isTurn = Math.hypot(place.x - before.x, place.y - before.y) < STANDS_M;
    const wanted = this.isObject(body) ? asObject(place, before, isTurn) : place;
    const move = this.movement({ body, place: wanted }, before);
    return move ? this.do({ ...move, name: `${isTurn ? "turn" : "move"} ${body}` }) : Promise.resolve(false);
  }

  // Sets exactly these poses; robots stay upright on the floor. Resolves to true if all bodies now
  // have their pose.
  pose(posed: readonly Posed[]): Promise<boolean> {
    const moves = posed.flatMap((each) => {
      const before = this.placeOf(each.body);
      const move = before && this.movement({ body: each.body, place: this.allowed(each) }, before);
      return move ? [move] : [];
    });
    return this.doTogether("move", moves);
  }

  // Rotates each body counter-clockwise about the vertical axis through its origin, as one edit. The
  // angle is in radians. Resolves to true if all bodies now have their new pose.
  turn(bodies: readonly string[], angle: number): Promise<boolean> {
    const turns = bodies.flatMap((body) => {
      const before = this.placeOf(body);
      if (!before) return [];
      const turned = { x: before.x, y: before.y, yaw: before.yaw + angle };
      const place = this.isObject(body) ? asObject(turned, before, true) : turned;
      const turn = this.movement({ body, place }, before);
      return turn ? [{ ...turn, name: `turn ${body}` }] : [];
    });
    return this.doTogether("turn", turns);
  }

  // Adds an object and selects it, so that it can be moved.
  async addObject(object: NewObject, name = ""): Promise<boolean> {
    const { simulation, selection } = this.store.get();
    if (!simulation) return false;
    const robot = selection ?? this.robotBefore;
    const added: string[] = [];
    const edit = this.addition(simulation, object, added);
    if (!(await this.do(name ? { ...edit, name: `add ${name}` } : edit))) return false;
    this.choose(added[0]!);
    this.robotBefore = robot;
    return true;
  }

  removeObject(object: string): Promise<boolean> {
    const removal = this.removalOfObject(object);
    return removal ? this.do(removal) : Promise.resolve(false);
  }

  add(robot: RobotSetUp, isAvatar: boolean): Promise<boolean> {
    const { simulation } = this.store.get();
    return simulation ? this.do(this.arrival(simulation, robot, isAvatar, [])) : Promise.resolve(false);
  }

  remove(robot: string): Promise<boolean> {
    const removal = this.removalOfRobot(robot, this.choicesOf([robot]));
    return removal ? this.do(removal) : Promise.resolve(false);
  }

  // Removes robots and objects as one edit.
  removeAll(bodies: readonly string[]): Promise<boolean> {
    const choices = this.choicesOf(bodies);
    const removals = bodies.flatMap(
      (body) => (this.isObject(body) ? this.removalOfObject(body) : this.removalOfRobot(body, choices)) ?? [],
    );
    if (removals.length === 0) return Promise.resolve(false);
    return this.do(removals.length === 1 ? removals[0]! : inOrder(`remove ${removals.length} bodies`, removals));
  }

  // Whether paste() has something to add.
  get hasCopies(): boolean {
    return this.copied.length > 0;
  }

  // Stores copies of the bodies for paste(). Returns their number.
  copy(bodies: readonly string[]): number {
    this.copied = bodies.flatMap((body) => {
      const place = this.placeOf(body);
      const robot = this.isObject(body) ? null : this.robotAgain(body);
      if (!place || (robot === null && !this.isObject(body))) return [];
      return [{ body, robot: robot && { ...robot, name: "" }, isAvatar: this.isAvatar(body), place }];
    });
    this.copiedChoices = this.choicesOf(bodies)();
    this.pastes = 0;
    return this.copied.length;
  }

  // Adds the copied bodies beside the originals, and selects the new bodies.
  async paste(): Promise<boolean> {
    const { simulation } = this.store.get();
    const { copied } = this;
    if (!simulation || copied.length === 0) return false;
    const shift = ++this.pastes * PASTED_AT_M;
    const choices = await this.copiedChoices;
    const names: string[] = [];
    const additions = copied.map(({ body, robot, isAvatar, place }) => {
      const there = { ...place, x: place.x + shift, y: place.y + shift };
      if (!robot) return this.addition(simulation, { name: "", copy_of: body, place: there }, names);
      return this.arrival(simulation, { ...robot, ...choices.get(body), place: upright(there) }, isAvatar, names);
    });
    const what = copied.length === 1 ? copied[0]!.body : `${copied.length} bodies`;
    if (!(await this.do(inOrder(`paste ${what}`, additions)))) return false;
    const [first, ...more] = names;
    const isFirstObject = copied[0]!.robot === null;
    this.patch({ chosen: isFirstObject ? first! : null, more });
    this.store.set({ selection: isFirstObject ? null : first! });
    return true;
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

  private movement({ body, place }: Posed, before: BodyPlace): Edit | null {
    const { simulation } = this.store.get();
    if (!simulation) return null;
    return {
      name: `move ${body}`,
      apply: () => this.put(simulation, body, place),
      revert: () => this.put(simulation, body, before),
    };
  }

  // Returns the edit that adds an object. The edit adds the object's name to `names`.
  private addition(simulation: string, object: NewObject, names: string[]): Edit {
    let { name, place } = object;
    return {
      name: `add ${object.model ?? object.copy_of}`,
      apply: async () => {
        name = await this.api.addObject(simulation, { ...object, name, place });
        names.push(name);
        await this.hasCome(name);
      },
      revert: async () => {
        place = this.placeOf(name) ?? place; // where redo adds the object again
        await this.api.removeObject(simulation, name);
        await this.hasGone(name);
      },
    };
  }

  // Waits until the received scene and poses include a body that was added. Until then, the body
  // cannot be selected, moved or removed.
  private hasCome(body: string): Promise<void> {
    return this.until(() => this.bodyOf(body) !== undefined && this.bodies.placeOf(body) !== null);
  }

  // Waits until the received scene no longer includes a body that was removed.
  private hasGone(body: string): Promise<void> {
    return this.until(() => this.bodyOf(body) === undefined);
  }

  // Stops waiting after some seconds, because the connection may be lost. Also stops if the page
  // shows another simulation.
  private async until(isTrue: () => boolean): Promise<void> {
    const { simulation } = this.store.get();
    const end = Date.now() + SHOWN_WITHIN_MS;
    const isWanted = () => Date.now() < end && this.store.get().simulation === simulation;
    while (!isTrue() && isWanted()) await new Promise((resolve) => setTimeout(resolve, SHOWN_POLL_MS));
  }

  private arrival(simulation: string, robot: RobotSetUp, isAvatar: boolean, names: string[]): Edit {
    let { name, place } = robot;
    return {
      name: `add ${robot.model}`,
      apply: async () => {
        name = await this.api.addRobot(simulation, { ...robot, name, place }, isAvatar);
        names.push(name);
        await this.hasCome(name);
      },
      revert: async () => {
        const stood = this.placeOf(name);
        place = stood ? upright(stood) : place; // where redo adds the robot again
        await this.api.removeRobot(simulation, name);
        await this.hasGone(name);
      },
    };
  }

  private removalOfObject(object: string): Edit | null {
    const { simulation } = this.store.get();
    const place = this.placeOf(object);
    if (!simulation || !place) return null;
    return {
      name: `remove ${object}`,
      apply: async () => {
        await this.api.removeObject(simulation, object);
        await this.hasGone(object);
      },
      revert: async () => {
        await this.api.addObject(simulation, { name: object, copy_of: object, place });
        await this.hasCome(object);
      },
    };
  }

  private removalOfRobot(robot: string, choices: () => Promise<RobotChoices>): Edit | null {
    const { simulation } = this.store.get();
    const again = this.robotAgain(robot);
    if (!simulation || !again) return null;
    const isAvatar = this.isAvatar(robot);
    return {
      name: `remove ${robot}`,
      apply: async () => {
        await choices(); // after the removal, the server no longer knows them
        await this.api.removeRobot(simulation, robot);
        await this.hasGone(robot);
      },
      revert: async () => {
        await this.api.addRobot(simulation, { ...again, ...(await choices()).get(robot) }, isAvatar);
        await this.hasCome(robot);
      },
    };
  }

  // Returns a function that reads the chosen movement and drive of these robots at its first call,
  // and returns the same result at each further call. It reads nothing if no body can have such a
  // choice: the server knows the choices of robots of the world file, and avatars have none.
  private choicesOf(bodies: readonly string[]): () => Promise<RobotChoices> {
    const { simulation } = this.store.get();
    const canHave = (body: string) => {
      const known = this.bodyOf(body);
      return known !== undefined && known.isRobot && !known.isAvatar && !known.isOfWorld;
    };
    if (simulation === null || !bodies.some(canHave)) return () => Promise.resolve(NO_CHOICES);
    let read: Promise<RobotChoices> | null = null;
    return () => (read ??= this.readChoices(simulation));
  }

  private async readChoices(simulation: string): Promise<RobotChoices> {
    try {
      return await readRobotChoices(this.api, simulation);
    } catch (error) {
      const effect = "A robot that is added again or pasted gets the movement and the drive of its model";
      notify(this.store, "error", `${effect}, because its own cannot be read: ${(error as Error).message}`);
      return NO_CHOICES;
    }
  }

  // Returns the request that adds the robot again, without its chosen movement and drive, see
  // choicesOf(). A robot that is added again gets a new instance of its behaviour. A robot from the
  // world file needs only its name, and no model.
  private robotAgain(robot: string): RobotSetUp | null {
    const known = this.store.get().status?.robots.find(({ name }) => name === robot);
    const place = this.placeOf(robot);
    if (!known || !place) return null;
    const model = this.bodyOf(robot)?.isOfWorld ? "" : known.model;
    const { behaviour } = known;
    return { name: robot, model, place: upright(place), behaviour, constraint: "", movement: "", drive: "" };
  }

  private async put(simulation: string, body: string, place: BodyPlace): Promise<void> {
    await this.api.placeBody(simulation, body, place);
    this.unseen.set(body, place);
  }

  private placeOf(body: string): Required<BodyPlace> | null {
    const seen = this.bodies.placeOf(body);
    return seen && { ...seen, ...this.unseen.get(body) };
  }

  private bodyOf(body: string) {
    return this.store.get().scene?.bodies.find(({ name }) => name === body);
  }

  private isObject(body: string): boolean {
    const known = this.bodyOf(body);
    return known !== undefined && !known.isRobot && !known.isAvatar;
  }

  private isAvatar(body: string): boolean {
    return this.bodyOf(body)?.isAvatar === true;
  }

  private allowed({ body, place }: Posed): BodyPlace {
    return this.isObject(body) ? place : { x: place.x, y: place.y, yaw: place.yaw };
  }

  // Performs edits of different bodies as one edit. `verb` begins the name of this edit.
  private doTogether(verb: string, edits: readonly Edit[]): Promise<boolean> {
    if (edits.length === 0) return Promise.resolve(false);
    return this.do(edits.length === 1 ? edits[0]! : together(`${verb} ${edits.length} bodies`, edits));
  }

  private async do(edit: Edit): Promise<boolean> {
    if (!(await this.ask(() => edit.apply()))) return false;
    this.done = [...this.done, edit].slice(-MOST_EDITS);
    this.takenBack = [];
    this.tell();
    return true;
  }

  // Waits until the stream reports the pause, which may be some time after the server's answer.
  // Returns false if that takes longer than LONGEST_PAUSE_MS: the pause may have been refused.
  private standsStill(): Promise<boolean> {
    return new Promise((resolve) => {
      const timer = setTimeout(() => (unwatch(), resolve(false)), LONGEST_PAUSE_MS);
      const unwatch = this.store.watch(
        ({ status, simulation }) => status?.phase !== "running" || simulation === null,
        (stands) => stands && queueMicrotask(() => (clearTimeout(timer), unwatch(), resolve(true))),
      );
    });
  }

  // Ends editing. A selected object stays selected. But if the object was added while a robot was
  // selected, this robot is selected again.
  private end(): void {
    const object = this.store.get().editing?.chosen ?? null;
    if (object !== null) this.selectRobotBefore();
    const isObjectShown = object !== null && this.store.get().selection === null && this.isInScene(object);
    this.store.set({ editing: null, placing: false, chosenPose: null, ...(isObjectShown && { part: bodyPart(object) }) });
  }

  // Deselects the object, and selects the robot that was selected when the object was added.
  private selectRobotBefore(): void {
    const robot = this.robotBefore;
    this.choose(null);
    if (robot !== null && this.isInScene(robot)) this.store.set({ selection: robot, part: null });
  }

  private isInScene(body: string): boolean {
    return this.store.get().scene?.bodies.some(({ name }) => name === body) ?? false;
  }

  // Offers to resume the simulation after an edit for which it was paused. The offer ends when the
  // simulation is resumed, or is edited again.
  private offerToResume(): void {
    const isStillPaused = ({ status, editing }: State) => status?.phase === "paused" && editing === null;
    if (!this.hasPaused || !isStillPaused(this.store.get())) return;
    const run = () => isStillPaused(this.store.get()) && this.resume();
    const remove = offer(this.store, "The simulation is still paused.", { label: "Resume", run });
    const unwatch = this.store.watch(isStillPaused, (isPaused) => {
      if (isPaused) return;
      unwatch();
      remove();
    });
  }

  private tell(): void {
    this.patch({ undo: this.done.map(({ name }) => name), redo: this.takenBack.map(({ name }) => name) });
  }

  private patch(change: Partial<Editing>): void {
    this.store.set(({ editing }) => (editing ? { editing: { ...editing, ...change } } : {}));
  }

  // Performs an edit. Only one edit is performed at a time. Returns false if another edit is in
  // progress, or if the server refuses (the reason is shown).
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

// Returns the place without roll and pitch: a request that adds or moves a robot can specify only
// its yaw.
function upright(place: BodyPlace) {
  return { x: place.x, y: place.y, yaw: place.yaw, ...(place.z !== undefined && { z: place.z }) };
}

// Returns the place with the roll and pitch that the object had before the edit. If the edit only
// rotates the object, also keeps the object's height.
function asObject(place: Placed, before: BodyPlace, isTurn: boolean): BodyPlace {
  const { roll = 0, pitch = 0, z } = before;
  return { ...place, roll, pitch, ...(isTurn && z !== undefined && { z }) };
}
