// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { body, scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { mount } from "./WorldPanel";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const SONAR = { name: "sonar", type: "sonar", overlay: "lines" as const, link: "base", topic: "/b/sonar", view: null, units: { range: "m" }, pose: [0.2, 0, 0, 0, 0, 0, 1], parameters: { update_rate: 10, max: 5 } };
const SCENE = scene({
  bodies: [body("wall", { isRobot: false, isStatic: true, links: ["link"] }), body("crate", { model: "crate model", isRobot: false, isStatic: false, links: ["box"] }), body("b", { links: ["base", "arm"], sensors: [SONAR] })],
  inertials: new Map([["crate model", [{ link: "box", mass: 2.5, pose: [0, 0, 0, 0, 0, 0, 1], poseInModel: [0, 0, 0, 0, 0, 0, 1], inertia: [1, 1, 1, 0, 0, 0] as const }]]]),
  poses: [
    { body: 1, link: null },
    { body: 2, link: null },
    { body: 2, link: "arm" },
  ],
});

function opened() {
  const { ports, store, topics } = testPorts({ scene: SCENE, time: 4 });
  const { body: element, tools, whileOpen } = mount(ports);
  document.body.replaceChildren(...tools!, element);
  const end = whileOpen!();
  const choose = (id: string) => document.querySelector<HTMLButtonElement>(`[data-node="${id}"]`)!.click();
  const unfold = (summary: string) => {
    const details = [...document.querySelectorAll("details")].find((each) => (each.querySelector("summary")!.getAttribute("aria-label") ?? each.textContent)!.startsWith(summary))!;
    details.open = true;
    details.dispatchEvent(new Event("toggle"));
  };
  const facts = () => {
    const cells = [...document.querySelectorAll(".world-inspector dt, .world-inspector dd")].map(({ textContent }) => textContent!);
    return Object.fromEntries(cells.flatMap((cell, i) => (i % 2 === 0 ? [[cell, cells[i + 1]!]] : [])));
  };
  return { ports, store, topics, end, choose, unfold, facts };
}

test("robots come first, then moving bodies, then static ones; a text finds links and sensors too", () => {
  const { end } = opened();
  const names = () => [...document.querySelectorAll("[data-node]")].map((each) => each.textContent);
  expect(names()).toEqual(["brobot", "cratedynamic", "wallstatic"]);
  const filter = document.querySelector("input")!;
  filter.value = "sonar";
  filter.dispatchEvent(new Event("input"));
  expect(names().slice(0, 1)).toEqual(["brobot"]);
  expect(names()).toContain("sonarsonar");
  end();
});

test("an object and a moving link have their pose and its age", () => {
  const { topics, choose, unfold, facts, end } = opened();
  choose("crate");
  expect(facts()).toMatchObject({ Kind: "dynamic", Links: "1" });
  const poses = new Float64Array([1, 2, 3, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 5, 0, 0, 0, 0, Math.SQRT1_2, Math.SQRT1_2]);
  const send = () => topics.send("/gsv/poses", { stamp: { sec: 3, nsec: 500_000_000 }, step: 0n, layout_version: 1, poses });
  send();
  vi.advanceTimersByTime(250);
  expect(facts()).toMatchObject({ Position: "1.000, 2.000, 3.000 m", Age: "0.50 s" });
  unfold("Parts of b");
  choose("b::link::arm");
  send();
  vi.advanceTimersByTime(250);
  expect(facts()).toMatchObject({ Of: "b", Position: "5.000, 0.000, 0.000 m", Orientation: "0.0, 0.0, 90.0 ° (roll, pitch, yaw)" });
  choose("b::link::base");
  expect(facts()).toMatchObject({ Pose: "does not move relative to the model" });
  end();
  expect(topics.read).toEqual([]);
});

test("a sensor is shown with its reading, a plot button, its age, and a link to its messages", () => {
  const { ports, topics, choose, unfold, facts, end } = opened();
  unfold("Parts of b");
  choose("b::sensor::sonar");
  topics.send("/b/sonar", { header: { stamp: { sec: 3, nsec: 0 } }, range: 1.25 });
  vi.advanceTimersByTime(250);
  expect(facts()).toMatchObject({ Topic: "/b/sonar", Age: "1.00 s", range: "1.250 m" });
  document.querySelector<HTMLButtonElement>('[aria-label="Plot sonar range"]')!.click();
  expect(ports.plots.add).toHaveBeenCalledWith({ kind: "sensor", topic: "/b/sonar" }, "range", "m");
  [...document.querySelectorAll("button")].find(({ textContent }) => textContent === "Show messages")!.click();
  expect(ports.traffic.open).toHaveBeenCalledWith("/b/sonar");
  end();
});

test("an object has its mass, geometry, material and collision shapes", async () => {
  const { ports, choose, facts, end } = opened();
  const material = { colour: "#ff0000", opacity: 0.5, metalness: 0, roughness: 0.8, maps: ["light"] };
  ports.shapes.visuals.mockResolvedValue([{ name: "v", link: "box", shape: { kind: "box", size: [0.4, 0.4, 1 / 3] }, materials: [material] }]);
  choose("crate");
  await vi.advanceTimersByTimeAsync(250);
  expect(facts()).toMatchObject({
    Mass: "2.5 kg",
    Geometry: "box, 0.4 × 0.4 × 0.3333 m",
    Material: "#ff0000, opacity 0.5, metalness 0, roughness 0.8, maps of light",
    Collision: "none",
  });
  choose("wall");
  await vi.advanceTimersByTimeAsync(250);
  expect(facts().Mass).toBe("none: the object is static and does not move");
  end();
});

test("a sensor has its parameters and its transform", () => {
  const { topics, choose, unfold, facts, end } = opened();
  unfold("Parts of b");
  choose("b::sensor::sonar");
  const transform = { translation: { x: 0.2, y: 0, z: 0.1 }, rotation: { x: 0, y: 0, z: 0, w: 1 } };
  topics.send("/tf_static", { transforms: [{ header: { stamp: { sec: 0, nsec: 0 }, frame_id: "b/base_link" }, child_frame_id: "b/sonar", transform }] });
  vi.advanceTimersByTime(250);
  expect(facts()).toMatchObject({
    "Update rate": "10 Hz",
    "Parameter max": "5",
    "Position in the link": "0.200, 0.000, 0.000 m",
    Transform: "0.200, 0.000, 0.100 m in b/base_link, static",
  });
  end();
});

test("the tree shows the part that was selected elsewhere", () => {
  const { store, facts, end } = opened();
  store.set({ part: { body: "b", kind: "sensor", name: "sonar" } });
  expect(facts().Topic).toBe("/b/sonar");
  store.set({ part: null, selection: "b" });
  expect(facts().Kind).toBe("robot");
  expect(document.querySelector('[data-node="b"]')!.getAttribute("aria-pressed")).toBe("true");
  store.set({ selection: null });
  expect(document.querySelector('[aria-pressed="true"]')).toBeNull();
  end();
});

test("transforms are read only while they are unfolded, and have an age", () => {
  const { topics, unfold, choose, facts, end } = opened();
  expect(topics.read).toEqual([]);
  unfold("Transforms");
  expect(topics.read.sort()).toEqual(["/tf", "/tf_static"]);
  const transform = { translation: { x: 1, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w: 1 } };
  topics.send("/tf", { transforms: [{ header: { stamp: { sec: 3, nsec: 0 }, frame_id: "map" }, child_frame_id: "b/base_link", transform }] });
  topics.send("/tf_static", { transforms: [{ header: { stamp: { sec: 0, nsec: 0 }, frame_id: "b/base_link" }, child_frame_id: "b/sonar", transform }] });
  vi.advanceTimersByTime(600);
  choose("tf::b/base_link");
  expect(facts()).toMatchObject({ Parent: "map", Translation: "1.000, 0.000, 0.000 m", Age: "1.00 s" });
  choose("tf::b/sonar");
  expect(facts()).toMatchObject({ Parent: "b/base_link", Age: "static" });
  end();
  expect(topics.read).toEqual([]);
});
