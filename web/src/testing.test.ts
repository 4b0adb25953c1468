// @vitest-environment jsdom
import { beforeEach, describe, expect, it, vi } from "vitest";
import type { SceneDescription } from "./api/scene";
import type { World3D } from "./scene/World3D";
import { Store } from "./state/Store";
import type { State } from "./state/State";
import { initialState } from "./state/State";
import { exposeForTests } from "./testing";

describe("window.gsv.ready", () => {
  let frames: (() => void)[];
  const nextFrame = () => frames.splice(0).forEach((draw) => draw());

  beforeEach(() => {
    frames = [];
    vi.stubGlobal("requestAnimationFrame", (draw: () => void) => frames.push(draw));
  });

  it("waits for the shapes of a scene that arrives after the view", async () => {
    const world = { frames: 1 };
    const store = new Store<State>({ ...initialState, view: "open" });
    let isReady = false;
    exposeForTests(store, () => world as World3D);
    // Behaves like the view: it watches the scene too, but receives it after window.gsv does.
    store.watch(
      ({ scene }) => scene,
      (scene) => scene && store.set({ modelsMissing: 1 }),
    );
    void window.gsv.ready.then(() => (isReady = true));

    store.set({ scene: {} as SceneDescription });
    world.frames += 1; // the frame without the shape
    nextFrame();
    await Promise.resolve();
    expect(isReady).toBe(false);

    store.set({ modelsMissing: 0 });
    nextFrame();
    await Promise.resolve();
    expect(isReady).toBe(false); // the shape has arrived, but is not drawn yet

    world.frames += 1;
    nextFrame();
    await Promise.resolve();
    expect(isReady).toBe(true);
  });
});
