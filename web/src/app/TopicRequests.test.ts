import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { SceneBody, SceneDescription, SceneSensor } from "../api/scene";
import { initialState, type State } from "../state/State";
import { Store } from "../state/Store";
import { TopicRequests } from "./TopicRequests";

function body(name: string, ...sensors: string[]): SceneBody {
  return { name, sensors: sensors.map((sensor) => ({ topic: `/${name}/${sensor}` }) as SceneSensor) } as SceneBody;
}

function fixture(missing: string[], more: object = {}) {
  const scene = { bodies: [body("a", "sonar", "camera"), body("b", "camera"), body("wall")] };
  const store = new Store<State>({ ...initialState, simulation: "s", scene: scene as SceneDescription, ...more });
  const listTopics = vi.fn(async (_simulation: string, _robot: string) => {});
  return { requests: new TopicRequests({ listTopics }, store, () => missing), listTopics };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test("each robot whose subscribed sensors have no topics is requested once", () => {
  const { requests, listTopics } = fixture(["/a/sonar", "/a/camera", "/gsv/beams"]);
  requests.lookSoon();
  requests.lookSoon();
  expect(listTopics).not.toHaveBeenCalled(); // the server may still list them itself
  vi.runAllTimers();
  expect(listTopics.mock.calls).toEqual([["s", "a"]]);
});

test("a robot is requested if its subscribed beams are not offered", () => {
  const { requests, listTopics } = fixture(["/gsv/beams/b"]);
  requests.lookSoon();
  vi.runAllTimers();
  expect(listTopics.mock.calls).toEqual([["s", "b"]]);
});

test("a robot without sensors is not requested, for it has no beams to offer", () => {
  const { requests, listTopics } = fixture(["/gsv/beams/wall"]);
  requests.lookSoon();
  vi.runAllTimers();
  expect(listTopics).not.toHaveBeenCalled();
});

test("no robot is requested while all topics are listed, or before there is a scene", () => {
  const listed = fixture([]);
  listed.requests.lookSoon();
  const early = fixture(["/a/sonar"], { scene: null });
  early.requests.lookSoon();
  vi.runAllTimers();
  expect(listed.listTopics).not.toHaveBeenCalled();
  expect(early.listTopics).not.toHaveBeenCalled();
});

test("a server that did not answer is asked again after another subscription", async () => {
  const { requests, listTopics } = fixture(["/b/camera"]);
  listTopics.mockRejectedValueOnce(new Error("away"));
  requests.lookSoon();
  await vi.runAllTimersAsync();
  requests.lookSoon();
  await vi.runAllTimersAsync();
  expect(listTopics).toHaveBeenCalledTimes(2);
});
