// @vitest-environment jsdom
import { Blob } from "node:buffer"; // the Blob of jsdom cannot be read
import { beforeEach, expect, test, vi } from "vitest";
import { ApiError } from "../api/JsonServer";
import { testApp } from "../page/testApp";
import { body, scene } from "../scene/testScene";
import type { DroppedFile } from "../api/DroppedFile";
import { createSetUpPanel } from "../setup/SetUpPanel";

function dropped(path: string, size = 1): DroppedFile {
  return { path, size, content: async () => new Blob([]) as never };
}

function fakeApi() {
  return {
    worlds: vi.fn(async () => ["maze", "office"]),
    models: vi.fn(async () => [
      { name: "avatar", isAvatar: true },
      { name: "pebble", isAvatar: false },
    ]),
    ros2: vi.fn(async () => ({ isAvailable: true, reason: "", reach: "domain 0, this machine only", published: "" })),
    behaviours: vi.fn(async () => ({ offers: [], startCommand: "gsv-wander --broker here" })),
    preview: vi.fn(async (_scenario: unknown) => ({
      scene: scene({ bodies: [body("pebble")] }),
      poses: new Float64Array(7),
      warnings: [] as string[],
    })),
    create: vi.fn(async () => "fresh"),
    upload: vi.fn(async (files: { path: string }[]) => files.map(({ path }) => `/tmp/up/1/${path}`)),
  };
}

let api: ReturnType<typeof fakeApi>;

beforeEach(() => (api = fakeApi()));

async function opened() {
  const { app, store } = testApp({}, { setUp: api } as never);
  const joined = vi.spyOn(app.session, "joinNew").mockResolvedValue();
  const panel = createSetUpPanel(app);
  await app.setUp.open();
  return { app, store, panel, joined };
}

const settled = (app: { store: { get(): { setUp: { isBusy: boolean } | null } } }) =>
  vi.waitFor(() => expect(app.store.get().setUp?.isBusy ?? false).toBe(false));

const file = (name: string, text: string) => ({ name, size: text.length, text: async () => text });

function control(panel: HTMLElement, label: string): HTMLInputElement {
  const found = [...panel.querySelectorAll("label")].find(({ textContent }) => textContent === label)!;
  return panel.querySelector(`#${found.htmlFor}`)!;
}

test("it opens with a preview of the first built-in world and the choices", async () => {
  const { store, panel } = await opened();
  expect(api.preview).toHaveBeenCalledOnce();
  expect(api.preview.mock.calls[0]![0]).toMatchObject({ world: "office" });
  expect(store.get().scene?.bodies).toHaveLength(1);
  expect(control(panel, "Environment").value).toBe("office");
  expect(store.get().simulation).toBeNull();
});

test("a world dropped while the form opens is kept", async () => {
  const { app, store } = testApp({}, { setUp: api } as never);
  let answer = (_worlds: string[]) => {};
  api.worlds.mockReturnValueOnce(new Promise((resolve) => (answer = resolve)));
  const opening = app.setUp.open();
  await app.setUp.drop([dropped("mine.world")]);
  answer(["maze", "office"]);
  await opening;
  expect(store.get().setUp!.scenario.world).toBe("/tmp/up/1/mine.world");
});

test("without robots it explains what to do, and without offers which command starts one", async () => {
  const { app, panel } = await opened();
  expect(panel.textContent).toContain("No robots yet.");
  app.setUp.addRobot("robots", "pebble");
  await settled(app);
  expect(panel.querySelector(".offers-hint code")!.textContent).toBe("gsv-wander --broker here");
});

test("changes during a preview cause one more preview, of the last state", async () => {
  const { app } = await opened();
  api.preview.mockClear();
  for (const duration of [1, 2, 3, 4]) app.setUp.change({ duration });
  await settled(app);
  expect(api.preview.mock.calls.map(([scenario]) => (scenario as { duration: number }).duration)).toEqual([1, 4]);
});

test("the server's errors are shown beside their fields until they are fixed", async () => {
  const { app, panel } = await opened();
  api.preview.mockRejectedValueOnce(new ApiError(422, "there is no such model", "robots[0].model"));
  app.setUp.addRobot("robots", "pebble");
  await settled(app);
  const model = control(panel, "Model");
  expect(model.getAttribute("aria-invalid")).toBe("true");
  const error = panel.querySelector(`#${model.getAttribute("aria-describedby")}`)!;
  expect(error.textContent).toBe("there is no such model");
  app.setUp.changeRobot("robots", 0, { model: "pebble" });
  await settled(app);
  expect(control(panel, "Model").getAttribute("aria-invalid")).toBe("false");
});

test("problems without a field are at the end, and those of a robot at its row", async () => {
  const { app, panel } = await opened();
  app.setUp.addRobot("robots", "pebble");
  await settled(app);
  api.preview.mockRejectedValueOnce(new ApiError(422, "there is no room", "robots[0]"));
  expect(await app.setUp.place("pebble", { x: 1, y: 1, yaw: 0 })).toBe(false);
  expect(panel.querySelector("[data-row='robots[0]'] > .field-error")!.textContent).toBe("there is no room");
  api.create.mockRejectedValueOnce(new Error("The server cannot be reached. Check that gsv still runs."));
  await app.setUp.create();
  expect(panel.querySelector(".set-up-end .field-error")!.textContent).toBe("The server cannot be reached. Check that gsv still runs.");
  expect(app.store.get().setUp).not.toBeNull();
});

test("a robot is moved to the clicked place, and back by undo", async () => {
  const { app, store } = await opened();
  app.setUp.addRobot("robots", "pebble");
  expect(store.get().selection).toBe("pebble");
  expect(await app.editActions.place("pebble", { x: 1, y: 2, yaw: 3 })).toBe(true);
  expect(store.get().setUp!.scenario.robots[0]!.place).toEqual({ x: 1, y: 2, yaw: 3 });
  app.editActions.undo();
  expect(store.get().setUp!.scenario.robots[0]!.place).toBeNull();
  app.editActions.redo();
  expect(store.get().setUp!.scenario.robots[0]!.place).toEqual({ x: 1, y: 2, yaw: 3 });
  await settled(app);
});

test("a created simulation is joined, and the form closes", async () => {
  const { app, store, panel, joined } = await opened();
  await app.setUp.create();
  expect(api.create).toHaveBeenCalledWith(expect.objectContaining({ world: "office" }));
  expect(joined).toHaveBeenCalledWith("fresh");
  expect(store.get().setUp).toBeNull();
  expect(panel.hidden).toBe(true);
});

test("a click on Create right after a change is not lost, and two clicks create one simulation", async () => {
  const { app, panel } = await opened();
  let answer = () => {};
  const shown = await api.preview({});
  api.preview.mockReturnValueOnce(new Promise((resolve) => (answer = () => resolve(shown))));
  app.setUp.change({ duration: 5 }); // the user types a number and presses the button without leaving the field
  const create = panel.querySelector<HTMLButtonElement>(".set-up-end .primary")!;
  expect(create.disabled).toBe(false);
  create.click();
  create.click();
  answer();
  await vi.waitFor(() => expect(app.store.get().setUp).toBeNull());
  expect(api.create).toHaveBeenCalledOnce();
  expect(api.create).toHaveBeenCalledWith(expect.objectContaining({ duration: 5 }));
});

test("nothing can be created during an upload", async () => {
  const { app, panel } = await opened();
  let sent = (_worlds: string[]) => {};
  api.upload.mockReturnValueOnce(new Promise((resolve) => (sent = resolve)));
  const dropping = app.setUp.drop([dropped("mine.world")]);
  app.setUp.change({ duration: 5 });
  await vi.waitFor(() => expect(api.preview).toHaveBeenCalledTimes(2));
  const create = panel.querySelector<HTMLButtonElement>(".set-up-end .primary")!;
  expect(create.disabled).toBe(true);
  await app.setUp.create();
  expect(api.create).not.toHaveBeenCalled();
  sent(["/tmp/up/1/mine.world"]);
  await dropping;
  await settled(app);
  expect(create.disabled).toBe(false);
});

test("scenario files are loaded, including YAML, and other files are rejected with a sentence", async () => {
  const { app, store } = await opened();
  const yaml = "world: maze\nseed: 3\nrobots:\n  - {model: pebble, x: 1, y: 2, yaw: 0}\nfaults: []\n";
  await app.setUp.load(file("run.yaml", yaml));
  expect(store.get().setUp!.scenario).toMatchObject({ world: "maze", seed: 3, robots: [{ model: "pebble" }] });
  expect(store.get().notices.at(-1)!.sentence).toBe("run.yaml: faults is not supported on this page and was ignored.");
  await app.setUp.load(file("torn.yaml", "a: [b"));
  expect(store.get().notices.at(-1)!.sentence).toMatch(/^torn\.yaml cannot be read as a scenario: /);
  expect(store.get().setUp!.scenario.world).toBe("maze");
  await app.setUp.load(file("huge.yaml", "x".repeat(1_000_001)));
  expect(store.get().notices.at(-1)!.sentence).toContain("not be larger than 1 MB");
});

test("each of several dropped worlds can be chosen", async () => {
  const { app, store, panel } = await opened();
  await app.setUp.drop([dropped("w/model.sdf"), dropped("w/b.world"), dropped("w/a.world")]);
  await settled(app);
  expect(store.get().setUp!.scenario.world).toBe("/tmp/up/1/w/a.world");
  const choice = control(panel, "Environment") as unknown as HTMLSelectElement;
  expect([...choice.options].slice(0, 3).map(({ label }) => label)).toEqual(["w/a.world", "w/b.world", "maze"]);
  choice.value = "/tmp/up/1/w/b.world";
  choice.dispatchEvent(new Event("change"));
  await settled(app);
  expect(api.preview.mock.lastCall![0]).toMatchObject({ world: "/tmp/up/1/w/b.world" });
});

test("a world dropped on another page of the viewer opens the form", async () => {
  const { app, store } = testApp({}, { setUp: api } as never);
  await app.setUp.drop([dropped("mine.world")]);
  await settled(app);
  expect(store.get().setUp!.scenario.world).toBe("/tmp/up/1/mine.world");
  expect(api.models).toHaveBeenCalledOnce();
});

test("a dropped world is uploaded and shown, and other files get an error beside the field", async () => {
  const { app, store, panel } = await opened();
  await app.setUp.drop([dropped("w/mesh.stl"), dropped("w/my.world")]);
  await settled(app);
  expect(store.get().setUp!.scenario.world).toBe("/tmp/up/1/w/my.world");
  expect(api.preview.mock.lastCall![0]).toMatchObject({ world: "/tmp/up/1/w/my.world" });
  const refusal = new ApiError(400, "/tmp/up/1/holiday.jpg: this is no XML", "world");
  api.preview.mockRejectedValueOnce(refusal);
  await app.setUp.drop([dropped("holiday.jpg")]);
  await settled(app);
  const field = control(panel, "Environment").closest(".field")!;
  expect(field.querySelector(".field-error")!.textContent).toBe("holiday.jpg: this is no XML");
  await app.setUp.drop([dropped("big.sdf", 2 ** 31)]);
  expect(field.querySelector(".field-error")!.textContent).toContain("at most 64 MiB");
  expect(api.upload).toHaveBeenCalledTimes(2);
});

function switchOn(panel: HTMLElement, label: string): void {
  const input = control(panel, label);
  input.checked = true;
  input.dispatchEvent(new Event("change"));
}

test("with ROS 2 switched on, the form shows its settings, and a namespace for each robot", async () => {
  const { app, panel } = await opened();
  app.setUp.addRobot("robots", "pebble");
  await settled(app);
  expect(control(panel, "ROS 2 namespace").parentElement!.hidden).toBe(true);
  switchOn(panel, "Publish to ROS 2");
  await settled(app);
  expect(control(panel, "ROS 2 namespace").parentElement!.hidden).toBe(false);
  app.setUp.changeRobot("robots", 0, { namespace: "/" });
  await app.setUp.create();
  expect(api.create.mock.calls).toMatchObject([[{ ros2: { cmd_vel: "" }, robots: [{ namespace: "/" }] }]]);
});

test("a server without ROS 2 shows the reason", async () => {
  api.ros2.mockResolvedValue({ isAvailable: false, reason: "this gsv was built without ROS 2", reach: "", published: "" });
  const { panel } = await opened();
  await vi.waitFor(() => expect(panel.textContent).toContain("Not available: this gsv was built without ROS 2."));
  expect(control(panel, "Publish to ROS 2").parentElement!.hidden).toBe(true);
});

test("the server's error about ROS 2 is shown beside the switch", async () => {
  const { app, panel } = await opened();
  api.preview.mockRejectedValue(new ApiError(400, "a namespace must begin with a slash", "ros2.namespaces.pebble"));
  switchOn(panel, "Publish to ROS 2");
  await settled(app);
  expect(control(panel, "Publish to ROS 2").getAttribute("aria-invalid")).toBe("true");
});
