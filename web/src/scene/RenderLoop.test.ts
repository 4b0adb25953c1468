import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { RenderLoop } from "./RenderLoop";

// The callbacks that were passed to requestAnimationFrame(). frameAt() calls them.
let asked: FrameRequestCallback[] = [];

beforeEach(() => {
  asked = [];
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => asked.push(callback));
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
  vi.useRealTimers();
});

function frameAt(milliseconds: number): void {
  for (const callback of asked.splice(0)) callback(milliseconds);
}

test("any number of requests before a frame cause one frame", () => {
  const draw = vi.fn(() => false);
  const loop = new RenderLoop(draw, () => {});
  loop.request();
  loop.request();
  frameAt(0);
  expect(draw).toHaveBeenCalledOnce();
  expect(loop.frames).toBe(1);
});

test("the loop draws further frames while they differ, and then stops", () => {
  let left = 3;
  const loop = new RenderLoop(
    () => --left > 0,
    () => {},
  );
  loop.request();
  expect(loop.isBusy).toBe(true);
  for (let now = 0; now < 160; now += 16) frameAt(now);
  expect(loop.frames).toBe(3);
  expect(asked).toEqual([]);
  expect(loop.isBusy).toBe(false);
});

test("the time of a frame ends when it is drawn; time in another tab does not count", () => {
  const took = vi.fn();
  const loop = new RenderLoop(() => true, took);
  loop.request();
  frameAt(0);
  frameAt(20);
  frameAt(60_000);
  frameAt(60_030);
  expect(took.mock.calls).toEqual([[20], [30]]);
  expect(loop.frames).toBe(4);
});

test("the next frame begins when the last one is drawn", () => {
  let isDrawn = false;
  const fence = { mark: () => (isDrawn = false), isReached: () => isDrawn };
  const took = vi.fn();
  const loop = new RenderLoop(() => false, took, fence);
  loop.request();
  frameAt(0);
  loop.request();
  frameAt(16);
  frameAt(32);
  expect(loop.frames).toBe(1);
  isDrawn = true;
  frameAt(48);
  expect(loop.frames).toBe(2);
  expect(took.mock.calls).toEqual([[48]]);
});

test("after a slow frame there is a pause for all requests", () => {
  for (const [took, rest] of [
    [130, 80],
    [300, 150],
    [3000, 400],
  ] as const) {
    const loop = new RenderLoop(
      () => true,
      () => {},
    );
    loop.request();
    frameAt(0);
    frameAt(took);
    loop.request();
    vi.advanceTimersByTime(rest - 1);
    expect(asked).toEqual([]);
    vi.advanceTimersByTime(1);
    expect(asked).toHaveLength(1);
    frameAt(took + rest);
    expect(loop.frames).toBe(2);
    asked = [];
  }
});

test("if frames are slow, the next one begins after the page has reacted to a click", () => {
  const drawnAfterPress = (took: number) => {
    const now = vi.spyOn(performance, "now").mockReturnValue(0);
    const loop = new RenderLoop(
      () => true,
      () => {},
    );
    loop.request();
    frameAt(0);
    now.mockReturnValue(took);
    loop.holdBack();
    frameAt(took);
    const during = loop.frames;
    now.mockReturnValue(took + 121);
    frameAt(took + 121);
    asked = [];
    return [during, loop.frames];
  };
  expect(drawnAfterPress(80)).toEqual([1, 2]);
  expect(drawnAfterPress(20)[0]).toBe(2); // frames of 20 ms are not slow: no delay
});

test("while new content is awaited nothing is drawn, until hurry() is called", () => {
  const draw = vi.fn(() => false);
  const loop = new RenderLoop(draw, () => {});
  loop.await(1e9);
  loop.request();
  for (let now = 0; now < 160; now += 16) frameAt(now);
  expect(draw).not.toHaveBeenCalled();
  loop.hurry();
  frameAt(160);
  expect(draw).toHaveBeenCalledOnce();
});

test("after hurry() the next frame is drawn without a rest, even after a slow frame", () => {
  const loop = new RenderLoop(() => false, () => {});
  loop.request();
  frameAt(0);
  frameAt(500); // a slow frame
  loop.hurry();
  frameAt(516);
  expect(loop.frames).toBe(2);
});
