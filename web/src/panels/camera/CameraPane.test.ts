// @vitest-environment jsdom
import { beforeEach, expect, test, vi } from "vitest";
import type { CameraChoice, SceneSensor } from "../../api/scene";
import { camerasOf } from "../../api/scene";
import type { State } from "../../state/State";
import { body, scene } from "../../scene/testScene";
import { mount } from "./CameraPane";
import { CameraTile } from "./CameraTile";
import { testPorts } from "../contract/testPorts";

const EYE: SceneSensor = { name: "eye", type: "camera", overlay: "picture", link: "base", topic: "/a/eye", view: null };
const SCENE = scene({ bodies: [body("a", { sensors: [EYE] })] });

// jsdom has no canvas.
beforeEach(() => void vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null));

function opened(state: Partial<State>) {
  const { ports, store, topics } = testPorts({ scene: SCENE, camera: camerasOf(SCENE)[0]!, ...state });
  const { body, whileOpen } = mount(ports);
  whileOpen!();
  return { store, topics, waiting: () => body.querySelector(".picture-waiting")!.textContent };
}

test("a camera is subscribed when there is a view, and the pane waits for its image", () => {
  const { store, topics, waiting } = opened({ view: "starting" });
  expect(waiting()).toBe("Waiting for an image…");
  expect(topics.read).toEqual([]);
  store.set({ view: "open" });
  expect(topics.read).toEqual(["/a/eye"]);
});

test("nothing is subscribed while the panel is out of sight", () => {
  const { ports, topics } = testPorts({ scene: SCENE, camera: camerasOf(SCENE)[0]! });
  const { whileOpen } = mount(ports);
  expect(topics.read).toEqual([]);
  const end = whileOpen!();
  expect(topics.read).toEqual(["/a/eye"]);
  end();
  expect(topics.read).toEqual([]);
});

test("the pane does not wait for a recording without images", () => {
  const { store, waiting } = opened({});
  store.set({ replay: { start: 0, end: 10, speed: 1, loop: false } });
  expect(waiting()).toBe("The recording has no image of this camera up to this time.");
  store.set({ inPast: true, replay: { start: 0, end: 11, speed: 1, loop: false } });
  store.set({ simulation: "past" });
  expect(waiting()).toBe("Camera images of past times are not stored. Press Live to see the present image.");
  store.set({ inPast: false, replay: null });
  expect(waiting()).toBe("Waiting for an image…");
});

test("the grid subscribes to every camera, and a click on one selects it and shows it alone", () => {
  const other = { ...EYE, name: "rear", topic: "/a/rear" };
  const depth = { ...EYE, name: "depth", type: "depth_camera", overlay: "points" as const, topic: "/a/depth" };
  const { ports, store, topics } = testPorts({ scene: scene({ bodies: [body("a", { sensors: [EYE, other, depth] })] }) });
  ports.cameras.show.mockImplementation((camera: CameraChoice) => store.set({ camera }));
  ports.cameras.showAll.mockImplementation((allCameras: boolean) => store.set({ allCameras }));
  const { body: element, tools, whileOpen } = mount(ports);
  whileOpen!();
  const choice = tools![0] as HTMLSelectElement;
  expect([...choice.options].map(({ text }) => text)).toEqual(["All cameras (3)", "a · eye", "a · rear", "a · depth"]);
  choice.selectedIndex = 0;
  choice.dispatchEvent(new Event("change"));
  expect(topics.read.sort()).toEqual(["/a/depth", "/a/eye", "/a/rear"]);
  element.querySelectorAll<HTMLButtonElement>(".camera-open")[1]!.click();
  expect(store.get().camera?.topic).toBe("/a/rear");
  expect(topics.read).toEqual(["/a/rear"]);
});

test("a late image shows its age, and one that cannot be decoded shows an error", async () => {
  const { ports, store, topics } = testPorts({ scene: SCENE, time: 10 });
  vi.stubGlobal("createImageBitmap", async () => ({ width: 2, height: 2, close: () => {} }));
  const tile = new CameraTile(camerasOf(SCENE)[0]!, ports, "eye");
  tile.listen();
  const send = (sec: number) => topics.send("/a/eye", { header: { stamp: { sec, nsec: 0 } }, format: "jpeg", data: new Uint8Array(2) });
  const text = (part: string) => tile.element.querySelector(part)!.textContent;
  send(10);
  await vi.waitFor(() => expect(text(".picture-time")).toBe("0:10.00"));
  store.set({ time: 14.5 });
  tile.judgeAge();
  expect(text(".picture-time")).toBe("0:10.00 · 4.5 s old");
  vi.stubGlobal("createImageBitmap", async () => Promise.reject(new Error("no image")));
  send(15);
  await vi.waitFor(() => expect(text(".picture-waiting")).toBe("The image cannot be decoded (format jpeg)."));
  vi.unstubAllGlobals();
});
