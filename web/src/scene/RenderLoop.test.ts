import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { RenderLoop } from "./RenderLoop";

// The browser's frames, one at a time and at the times given here.
let asked: FrameRequestCallback[] = [];

beforeEach(() => {
  asked = [];
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => asked.push(callback));
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout"] });
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

function frameAt(milliseconds: number): void {
  for (const callback of asked.splice(0)) callback(milliseconds);
}

test("any number of requests before a frame draw one", () => {
  const draw = vi.fn(() => false);
  const loop = new RenderLoop(draw, () => {});
  loop.request();
  loop.request();
  frameAt(0);
  expect(draw).toHaveBeenCalledOnce();
  expect(loop.frames).toBe(1);
});

test("it goes on while frames differ, and asks for none afterwards", () => {
  let left = 3;
  const loop = new RenderLoop(
    () => --left > 0,
    () => {},
  );
  loop.request();
  for (let now = 0; now < 160; now += 16) frameAt(now);
  expect(loop.frames).toBe(3);
  expect(asked).toEqual([]);
});

test("only the time between successive frames counts as a frame's", () => {
  const took = vi.fn();
  let goesOn = true;
  const loop = new RenderLoop(() => goesOn, took);
  loop.request();
  frameAt(0);
  goesOn = false;
  frameAt(20);
  loop.request();
  frameAt(500);
  expect(took.mock.calls).toEqual([[20]]);
});

test("after a frame that kept the machine busy it rests, whoever asks", () => {
  const loop = new RenderLoop(
    () => true,
    () => {},
  );
  loop.request();
  frameAt(0);
  frameAt(200);
  loop.request();
  expect(asked).toEqual([]);
  vi.advanceTimersByTime(100);
  expect(asked).toHaveLength(1);
});
