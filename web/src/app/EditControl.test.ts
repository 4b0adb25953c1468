import { expect, test, vi } from "vitest";
import type { BodyPlace } from "../api/SetUpApi";
import { ApiError } from "../api/JsonServer";
import { robotStatus, simulationStatus } from "../page/testApp";
import { newRobot, EMPTY_SCENARIO } from "../api/scenario";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { body, scene } from "../scene/testScene";
import { EditActions } from "./EditActions";
import { EditControl } from "./EditControl";

const BEFORE = { x: 0, y: 0, z: 0.1, roll: 0, pitch: 0, yaw: 0 };
const UPRIGHT = { x: 0, y: 0, z: 0.1, yaw: 0 };
const OWN = { movement: "rigid", drive: "diff,radius=0.1" }; // movement and drive in SCENARIO
const AFTER = { x: 1, y: 2, yaw: 0.5 };

// As the server writes it for a robot "a" that was added with its own movement and drive.
const SCENARIO = `world: house.sdf
robots:
  - {name: a, model: b21r, x: 0, y: 0, z: 0.1, yaw: 0, behaviour: wander, movement: rigid, drive: "diff,radius=0.1"}
`;

async function editing(here: Required<BodyPlace> = BEFORE, phase: "paused" | "running" = "paused") {
  const store = new Store<State>({
    ...initialState,
    connection: { phase: "open" },
    abilities: { ...initialState.abilities, creates: true },
    simulation: "house",
    scene: scene({ bodies: [body("a"), body("box", { isRobot: false })] }),
    status: simulationStatus(phase, { robots: [robotStatus("a")] }),
  });
  const without = (name: string) => (store.get().scene?.bodies ?? []).filter((each) => each.name !== name);
  const arrive = (name: string, isRobot: boolean) =>
    store.set({ scene: scene({ bodies: [...without(name), body(name, { isRobot })] }) });
  const leave = async (_: string, name: string) => store.set({ scene: scene({ bodies: without(name) }) });
  const api = {
    models: vi.fn(async () => []),
    objectModels: vi.fn(async () => ["crate"]),
    behaviours: vi.fn(async () => ({ offers: [], startCommand: "" })),
    placeBody: vi.fn(async () => {}),
    addRobot: vi.fn(async (_: string, { name }: { name: string }) => (arrive(name || "b_2", true), name || "b_2")),
    removeRobot: vi.fn(leave),
    addObject: vi.fn(async (_: string, { name }: { name: string }) => (arrive(name || "crate_2", false), name || "crate_2")),
    removeObject: vi.fn(leave),
    saveWorld: vi.fn(async () => {
      const isThere = store.get().scene!.bodies.some(({ name }) => name === "a");
      return { sdf: "<sdf/>", scenario: isThere ? SCENARIO : "world: house.sdf\n", warnings: [] };
    }),
  };
  const pause = vi.fn(async () => store.set({ status: simulationStatus("paused") }));
  const resume = vi.fn();
  const control = new EditControl(store, api as never, { placeOf: () => here }, pause, resume);
  await control.toggle();
  return { store, api, pause, resume, control };
}

test("a move is undone with its height, and redone", async () => {
  const { store, api, control } = await editing();
  expect(await control.place("a", AFTER)).toBe(true);
  expect(store.get().editing!.undo).toEqual(["move a"]);
  await control.undo();
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "a", BEFORE);
  expect(store.get().editing).toMatchObject({ undo: [], redo: ["move a"] });
  await control.redo();
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "a", AFTER);
});

test("undo removes an added body by its name", async () => {
  const { api, control } = await editing();
  await control.add({ ...newRobot(EMPTY_SCENARIO, "b"), name: "" }, false);
  await control.undo();
  expect(api.removeRobot).toHaveBeenCalledWith("house", "b_2");
  await control.redo();
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "b_2", place: UPRIGHT }), false);
});

test("a removed robot is restored at its place with its behaviour", async () => {
  const { api, control } = await editing();
  await control.remove("a");
  expect(api.removeRobot).toHaveBeenCalledWith("house", "a");
  await control.undo();
  const again = expect.objectContaining({ name: "a", model: "b21r", behaviour: "wander", place: UPRIGHT });
  expect(api.addRobot).toHaveBeenCalledWith("house", again, false);
});

test("a removed robot is restored with its movement and its drive", async () => {
  const { store, api, control } = await editing();
  await control.remove("a");
  await control.undo();
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "a", ...OWN }), false);
  await control.redo();
  await control.undo();
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "a", ...OWN }), false);
  await control.removeAll(["box", "a"]);
  await control.undo();
  expect(api.addRobot).toHaveBeenCalledTimes(3);
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "a", ...OWN }), false);
  expect(store.get().notices).toEqual([]);
});

test("a pasted robot has the movement and the drive of the original, even if the original was removed", async () => {
  const { api, control } = await editing();
  expect(control.copy(["a"])).toBe(1);
  await control.paste();
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "", ...OWN }), false);
  await control.remove("a");
  await control.paste();
  expect(api.addRobot).toHaveBeenCalledTimes(2);
  expect(api.addRobot).toHaveBeenLastCalledWith("house", expect.objectContaining({ name: "", ...OWN }), false);
});

test("if the movement and the drive cannot be read, the robot is removed, and an error states the effect", async () => {
  const { store, api, control } = await editing();
  api.saveWorld.mockRejectedValueOnce(new ApiError(422, "the file of the world does not exist any more"));
  expect(await control.remove("a")).toBe(true);
  expect(store.get().notices.map(({ sentence }) => sentence)).toEqual([
    "A robot that is added again or pasted gets the movement and the drive of its model, because its own cannot be read: the file of the world does not exist any more",
  ]);
  await control.undo();
  expect(api.addRobot).toHaveBeenCalledWith("house", expect.objectContaining({ name: "a", movement: "", drive: "" }), false);
});

test("nothing is read for objects, avatars and robots of the world file", async () => {
  const { store, api, control } = await editing();
  control.copy(["box"]);
  await control.removeObject("box");
  store.set({ scene: scene({ bodies: [body("a", { isOfWorld: true })] }) });
  await control.remove("a");
  store.set({ scene: scene({ bodies: [body("a", { isAvatar: true })] }) });
  await control.remove("a");
  expect(api.removeRobot).toHaveBeenCalledTimes(2);
  expect(api.saveWorld).not.toHaveBeenCalled();
});

test("a robot of the world file is restored by its name only", async () => {
  const { store, api, control } = await editing();
  store.set({ scene: scene({ bodies: [body("a", { isOfWorld: true })] }) });
  await control.remove("a");
  await control.undo();
  expect(api.addRobot).toHaveBeenCalledWith("house", expect.objectContaining({ name: "a", model: "" }), false);
});

test("a restored robot is upright, because its request has no roll and pitch", async () => {
  const { api, control } = await editing({ ...BEFORE, roll: 0, pitch: 0 });
  await control.remove("a");
  await control.undo();
  expect(api.addRobot).toHaveBeenCalledWith("house", expect.objectContaining({ place: UPRIGHT }), false);
});

test("a refused edit is reported and not stored", async () => {
  const { store, api, control } = await editing();
  api.placeBody.mockRejectedValueOnce(new ApiError(422, "there is no room at (1, 2)"));
  expect(await control.place("a", AFTER)).toBe(false);
  expect(store.get().notices.at(-1)!.sentence).toBe("there is no room at (1, 2)");
  expect(store.get().editing).toMatchObject({ undo: [], isBusy: false });
});

test("editing pauses a running simulation, and ends when it resumes", async () => {
  const { store, pause } = await editing(BEFORE, "running");
  expect(pause).toHaveBeenCalledOnce();
  expect(store.get().editing).not.toBeNull();
  store.set({ status: simulationStatus("running") });
  expect(store.get().editing).toBeNull();
});

test("an added object is selected, and undo and redo keep its name", async () => {
  const { store, api, control } = await editing();
  expect(store.get().editing!.objects).toEqual(["crate"]);
  expect(await control.addObject({ name: "", model: "crate", place: null })).toBe(true);
  expect(api.addObject).toHaveBeenCalledWith("house", { name: "", model: "crate", place: null });
  expect(store.get().editing).toMatchObject({ chosen: "crate_2", undo: ["add crate"] });
  await control.undo();
  expect(api.removeObject).toHaveBeenCalledWith("house", "crate_2");
  await control.redo();
  expect(api.addObject).toHaveBeenLastCalledWith("house", { name: "crate_2", model: "crate", place: BEFORE });
});

test("a removed object is restored as a copy at its former place", async () => {
  const { api, control } = await editing();
  await control.removeObject("box");
  await control.undo();
  expect(api.addObject).toHaveBeenCalledWith("house", { name: "box", copy_of: "box", place: BEFORE });
});

test("a rotation keeps an object's height, and a move puts it on the floor", async () => {
  const { store, api, control } = await editing();
  await control.turn(["box"], 0.5);
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "box", { ...BEFORE, yaw: 0.5, roll: 0, pitch: 0 });
  await control.place("box", AFTER);
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "box", { ...AFTER, roll: 0, pitch: 0 });
  expect(store.get().editing!.undo).toEqual(["turn box", "move box"]);
});

test("a rotation continues from the last one, even if the scene does not show it yet", async () => {
  const { api, control } = await editing();
  await control.turn(["box"], 0.5);
  await control.turn(["box"], 0.25);
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "box", expect.objectContaining({ yaw: 0.75 }));
  await control.undo();
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "box", expect.objectContaining({ yaw: 0.5 }));
});

test("a selection ends when its object is removed", async () => {
  const { store, control } = await editing();
  control.choose("box");
  expect(store.get().editing!.chosen).toBe("box");
  store.set({ scene: scene({ bodies: [body("a")] }) });
  expect(store.get().editing!.chosen).toBeNull();
});

test("several bodies move as one edit; robots stay upright", async () => {
  const { api, control } = await editing();
  const tilted = { x: 1, y: 1, z: 2, roll: 0.5, pitch: 0, yaw: 1 };
  expect(await control.pose([{ body: "a", place: tilted }, { body: "box", place: tilted }])).toBe(true);
  expect(api.placeBody.mock.calls).toEqual([
    ["house", "a", { x: 1, y: 1, yaw: 1 }],
    ["house", "box", tilted],
  ]);
  api.placeBody.mockClear();
  await control.undo();
  expect(api.placeBody.mock.calls).toEqual([
    ["house", "box", BEFORE],
    ["house", "a", BEFORE],
  ]);
});

test("several bodies turn about their own origins as one edit, which one undo takes back", async () => {
  const { store, api, control } = await editing({ x: 1, y: 2, z: 0.1, roll: 0.3, pitch: 0, yaw: 0.25 });
  control.choose("box");
  control.chooseMore(["a"]);
  const actions = new EditActions(store, api as never, control, {} as never, () => null, () => null);
  actions.turn(0.5);
  await vi.waitFor(() => expect(store.get().editing!.undo).toEqual(["turn 2 bodies"]));
  expect(api.placeBody.mock.calls).toEqual([
    ["house", "box", { x: 1, y: 2, z: 0.1, roll: 0.3, pitch: 0, yaw: 0.75 }],
    ["house", "a", { x: 1, y: 2, yaw: 0.75 }],
  ]);
  await control.undo();
  expect(api.placeBody.mock.calls.slice(2)).toMatchObject([
    ["house", "a", { x: 1, y: 2, yaw: 0.25 }],
    ["house", "box", { x: 1, y: 2, roll: 0.3, yaw: 0.25 }],
  ]);
  expect(store.get().editing!.undo).toEqual([]);
});

test("if one of several bodies cannot turn, none turns", async () => {
  const { store, api, control } = await editing();
  api.placeBody.mockImplementation((async (_: string, name: string) => {
    if (name === "a") throw new ApiError(422, "a would overlap a wall");
  }) as never);
  expect(await control.turn(["box", "a"], 0.5)).toBe(false);
  expect(api.placeBody).toHaveBeenLastCalledWith("house", "box", BEFORE);
  expect(store.get().editing!.undo).toEqual([]);
});

test("a copied body is pasted beside the original each time, and is then selected", async () => {
  const { api, control, store } = await editing();
  expect(control.copy(["box", "a"])).toBe(2);
  await control.paste();
  expect(api.addObject).toHaveBeenCalledWith("house", expect.objectContaining({ copy_of: "box", place: { ...BEFORE, x: 0.5, y: 0.5 } }));
  expect(api.addRobot).toHaveBeenCalledWith("house", expect.objectContaining({ name: "", place: { ...UPRIGHT, x: 0.5, y: 0.5 } }), false);
  expect(store.get().editing).toMatchObject({ chosen: "crate_2", more: ["b_2"], undo: ["paste 2 bodies"] });
  await control.paste();
  expect(api.addObject).toHaveBeenLastCalledWith("house", expect.objectContaining({ place: { ...BEFORE, x: 1, y: 1 } }));
  await control.undo();
  expect(api.removeRobot).toHaveBeenCalledTimes(1);
  expect(api.removeObject).toHaveBeenCalledTimes(1);
});

test("an edit lasts until the scene shows it, so that the next one finds the body", async () => {
  const { store, api, control } = await editing();
  api.addObject.mockResolvedValueOnce("crate_2"); // the scene arrives later than the answer
  const added = control.addObject({ name: "", model: "crate", place: null });
  await vi.waitFor(() => expect(api.addObject).toHaveBeenCalled());
  expect(store.get().editing).toMatchObject({ isBusy: true, chosen: null });
  store.set(({ scene: before }) => ({ scene: scene({ bodies: [...before!.bodies, body("crate_2", { isRobot: false })] }) }));
  expect(await added).toBe(true);
  expect(store.get().editing).toMatchObject({ isBusy: false, chosen: "crate_2" });
  expect(await control.removeAll(["crate_2"])).toBe(true);
  expect(api.removeObject).toHaveBeenCalledWith("house", "crate_2");
});

test("bodies that another person removes are no longer selected", async () => {
  const { store, control } = await editing();
  control.copy(["box", "a"]);
  await control.paste();
  expect(store.get().editing).toMatchObject({ chosen: "crate_2", more: ["b_2"] });
  store.set(({ scene: before }) => ({ scene: scene({ bodies: before!.bodies.filter(({ name }) => name !== "b_2") }) }));
  expect(store.get().editing).toMatchObject({ chosen: "crate_2", more: [] });
});

test("several bodies are removed as one edit, and restored together", async () => {
  const { api, control, store } = await editing();
  control.choose("box");
  control.chooseMore(["a"]);
  await control.removeAll(["box", "a"]);
  expect(api.removeObject).toHaveBeenCalledWith("house", "box");
  expect(api.removeRobot).toHaveBeenCalledWith("house", "a");
  await control.undo();
  expect(api.addObject).toHaveBeenCalledTimes(1);
  expect(api.addRobot).toHaveBeenCalledTimes(1);
  store.set({ scene: scene({ bodies: [body("box", { isRobot: false })] }) });
  expect(store.get().editing?.more).toEqual([]); // a removed body is no longer selected
});

test("after an edit that paused the simulation, a notice offers to resume it", async () => {
  const { store, resume, control } = await editing(BEFORE, "running");
  await control.toggle();
  const notice = store.get().notices.at(-1)!;
  expect(notice.sentence).toBe("The simulation is still paused.");
  notice.action!.run();
  expect(resume).toHaveBeenCalledTimes(1);
  store.set({ status: simulationStatus("running") });
  expect(store.get().notices).toEqual([]);
  notice.action!.run();
  expect(resume).toHaveBeenCalledTimes(1);
});

test("a robot is selected again at the end, if an object was added for it", async () => {
  const { store, control } = await editing();
  store.set({ selection: "a" });
  await control.addObject({ name: "", model: "crate", place: null });
  expect(store.get()).toMatchObject({ selection: null, editing: { chosen: "crate_2" } });
  await control.toggle();
  expect(store.get()).toMatchObject({ selection: "a", part: null });
});

test("a robot is selected again if undo removes the object that was added for it", async () => {
  const { store, control } = await editing();
  store.set({ scene: scene({ bodies: [body("a"), body("crate_2", { isRobot: false })] }), selection: "a" });
  await control.addObject({ name: "", model: "crate", place: null });
  store.set({ scene: scene({ bodies: [body("a")] }) });
  expect(store.get()).toMatchObject({ selection: "a", editing: { chosen: null } });
});

test("an object that the user selected stays selected at the end", async () => {
  const { store, control } = await editing();
  store.set({ selection: "a" });
  control.choose("box");
  await control.toggle();
  expect(store.get()).toMatchObject({ selection: null, part: { body: "box", kind: "body", name: "box" } });
});

test("after an edit of a simulation that was paused before, nothing offers to resume it", async () => {
  const { store, control } = await editing();
  await control.toggle();
  expect(store.get().notices).toEqual([]);
});

test("editing does not begin by itself long after a pause that was refused", async () => {
  vi.useFakeTimers();
  try {
    const { store, pause, control } = await editing();
    await control.toggle();
    store.set({ status: simulationStatus("running") });
    pause.mockImplementation(async () => {});
    const toggled = control.toggle();
    await vi.advanceTimersByTimeAsync(10_000);
    await toggled;
    expect(store.get().notices.at(-1)!.sentence).toBe("The simulation still runs. Pause it to edit it.");
    store.set({ status: simulationStatus("finished") });
    await vi.advanceTimersByTimeAsync(60_000);
    expect(store.get().editing).toBeNull();
  } finally {
    vi.useRealTimers();
  }
});
