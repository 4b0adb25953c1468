// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { scene } from "../../scene/testScene";
import { testPorts } from "../contract/testPorts";
import { MessageTree, jsonOf } from "./MessageTree";
import { Rates } from "./rates";
import { mount } from "./TopicsPanel";

beforeEach(() => void vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "setInterval", "clearInterval", "performance"] }));
afterEach(() => void vi.useRealTimers());

const TOPICS = [
  { name: "/a/scan", type: "sensor_msgs/msg/LaserScan" },
  { name: "/gsv/status", type: "gsv_msgs/msg/SimulationStatus" },
];

function opened() {
  const { ports, store, topics } = testPorts({ topics: TOPICS, scene: scene({ bodies: [] }) });
  const { body, tools, whileOpen } = mount(ports);
  const end = whileOpen!();
  const press = (label: string) => body.querySelector<HTMLButtonElement>(`[aria-label="${label}"]`)!.click();
  const choose = (topic: string) => body.querySelector<HTMLButtonElement>(`[data-topic="${topic}"]`)!.click();
  const lines = () => [...body.querySelectorAll(".tree-line")].map((line) => line.textContent);
  return { ports, store, topics, body, tools: tools!, end, press, choose, lines };
}

test("topics are listed with their types, and filtered by text", () => {
  const { body, tools } = opened();
  const rows = () => [...body.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent));
  expect(rows()).toEqual([
    ["/a/scan", "sensor_msgs/msg/LaserScan", "–", "–"],
    ["/gsv/status", "gsv_msgs/msg/SimulationStatus", "–", "–"],
  ]);
  const filter = tools[0] as HTMLInputElement;
  filter.value = "laser";
  filter.dispatchEvent(new Event("input"));
  expect(rows().map(([name]) => name)).toEqual(["/a/scan"]);
});

test("the newest message of the selected topic is shown as a tree, and read only while the panel is in sight", () => {
  const { topics, choose, lines, end } = opened();
  expect(topics.read).toEqual([]);
  choose("/gsv/status");
  expect(topics.read).toEqual(["/gsv/status"]);
  topics.send("/gsv/status", { state: "paused", step: 12n, stamp: { sec: 1, nsec: 500_000_000 } });
  vi.advanceTimersByTime(250);
  expect(lines()).toEqual(['state"paused"', "step12", "stamp1.500 s"]);
  end();
  expect(topics.read).toEqual([]);
});

test("a frozen message keeps its time and is the one that is copied, and another topic is not frozen", () => {
  const { topics, ports, choose, press, lines, body } = opened();
  choose("/gsv/status");
  const send = (topic: string, v: number) => {
    topics.send(topic, { stamp: { sec: v, nsec: 0 }, v });
    vi.advanceTimersByTime(250);
  };
  send("/gsv/status", 10);
  press("Freeze this message");
  send("/gsv/status", 25);
  expect(lines()).toContain("v10");
  expect(body.querySelector('[role="status"]')!.textContent).toBe("At 0:10.00");
  press("Copy the message as JSON");
  expect(ports.notices.copy).toHaveBeenLastCalledWith(expect.stringContaining('"v": 10'), "Message copied.");
  choose("/a/scan");
  send("/a/scan", 30);
  expect(lines()).toContain("v30");
});

test("a field is plotted and copied by its path", () => {
  const { topics, ports, choose, press, body } = opened();
  choose("/gsv/status");
  topics.send("/gsv/status", { robots: [{ name: "a", x: 2 }] });
  vi.advanceTimersByTime(250);
  for (const text of ["robots", "[0]"]) {
    const fold = [...body.querySelectorAll("details")].find((each) => each.querySelector(".tree-name")!.textContent === text)!;
    fold.open = true;
    fold.dispatchEvent(new Event("toggle"));
  }
  press("Plot robots[0].x");
  expect(ports.plots.add).toHaveBeenCalledWith({ kind: "topic", topic: "/gsv/status" }, "robots[0].x", "");
  press("Copy robots[0]");
  expect(ports.notices.copy).toHaveBeenCalledWith('{\n "name": "a",\n "x": 2\n}', "robots[0] copied.");
  expect(body.querySelector<HTMLElement>('[aria-label="Plot robots[0].name"]')!.hidden).toBe(true);
});

test("a frozen message stays while others arrive", () => {
  const { topics, choose, press, lines } = opened();
  choose("/gsv/status");
  topics.send("/gsv/status", { step: 1 });
  vi.advanceTimersByTime(250);
  press("Freeze this message");
  topics.send("/gsv/status", { step: 2 });
  vi.advanceTimersByTime(250);
  expect(lines()).toEqual(["step1"]);
  press("Freeze this message");
  expect(lines()).toEqual(["step2"]);
});

test("a topic that becomes silent or ends is marked", () => {
  const { topics, store, choose, body } = opened();
  const note = () => body.querySelector('[role="status"]')!.textContent;
  choose("/a/scan");
  expect(note()).toBe("Waiting for a message…");
  topics.send("/a/scan", { header: { stamp: { sec: 2, nsec: 0 } } });
  vi.advanceTimersByTime(5000);
  expect(note()).toMatch(/^At 0:02.00. No message for [45] s.$/);
  store.set({ topics: [] });
  vi.advanceTimersByTime(1000);
  expect(note()).toBe("The server does not offer this topic any more. The last message stays.");
});

test("all listed topics are read while their rates are measured", () => {
  const { topics, ports, tools, body, end } = opened();
  const box = tools[1]!.querySelector("input")!;
  box.checked = true;
  box.dispatchEvent(new Event("change"));
  expect(topics.read).toEqual(["/a/scan", "/gsv/status"]);
  ports.traffic.counts.mockReturnValue(new Map([["/a/scan", { messages: 20, bytes: 4000 }]]));
  vi.advanceTimersByTime(1000);
  expect(body.querySelector("tbody tr")!.textContent).toBe("/a/scansensor_msgs/msg/LaserScan20.04.0");
  end();
  expect(topics.read).toEqual([]);
});

test("rates are computed over the last seconds", () => {
  const rates = new Rates();
  const at = (ms: number, messages: number) => rates.update(new Map([["/a", { messages, bytes: 10 * messages }]]), ms).get("/a");
  expect(at(0, 100)).toBeUndefined();
  expect(at(1000, 110)).toEqual({ rate: 10, bytesPerSecond: 100 });
  for (let s = 2; s <= 10; s++) at(1000 * s, 110);
  expect(at(11_000, 110)).toEqual({ rate: 0, bytesPerSecond: 0 });
});

test("the first hundred elements of a long list are shown", () => {
  const tree = new MessageTree({ plot: () => {}, copy: () => {} });
  tree.show({ data: new Float32Array(5000) });
  const fold = tree.element.querySelector("details")!;
  expect(fold.textContent).toBe("data 5,000 numbers");
  fold.open = true;
  fold.dispatchEvent(new Event("toggle"));
  expect(fold.querySelectorAll(".tree-line")).toHaveLength(100);
  expect(fold.textContent).toContain("… 4,900 more");
});

test("every number has its place in JSON", () => {
  expect(JSON.parse(jsonOf({ a: 5n, b: 2n ** 60n, c: NaN, d: new Uint8Array([1, 2]) }))).toEqual({ a: 5, b: "1152921504606846976", c: "NaN", d: [1, 2] });
});
