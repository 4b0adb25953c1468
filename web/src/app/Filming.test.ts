import { beforeEach, expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { Filming, LARGEST_BYTES } from "./Filming";

class FakeRecorder {
  static newest: FakeRecorder;
  static isTypeSupported = (type: string) => type === "video/webm;codecs=vp8";
  state = "inactive";
  ondataavailable: (event: { data: Blob }) => void = () => {};
  onstop: () => void = () => {};

  constructor(
    readonly stream: unknown,
    readonly options: { mimeType: string },
  ) {
    FakeRecorder.newest = this;
  }

  start(): void {
    this.state = "recording";
  }

  stop(): void {
    this.state = "inactive";
    this.ondataavailable({ data: new Blob(["end"]) });
    this.onstop();
  }
}

const track = { stop: vi.fn() };

function filming() {
  const store = new Store<State>({ ...initialState, simulation: "house", time: 2 });
  const save = vi.fn<(name: string, content: Blob) => void>();
  const stream = { getTracks: () => [track] } as unknown as MediaStream;
  return { store, save, filming: new Filming(store, () => stream, save) };
}

beforeEach(() => void vi.stubGlobal("MediaRecorder", FakeRecorder));

test("the view between two clicks is saved as one file", async () => {
  const { store, save, filming: each } = filming();
  each.toggle();
  expect(store.get().filming).toBe(true);
  expect(FakeRecorder.newest.options.mimeType).toBe("video/webm;codecs=vp8");
  FakeRecorder.newest.ondataavailable({ data: new Blob(["begin "]) });
  each.toggle();
  expect(store.get().filming).toBe(false);
  expect(track.stop).toHaveBeenCalled();
  const [name, video] = save.mock.calls[0]!;
  expect(name).toBe("house video 2.00s.webm");
  expect(await video.text()).toBe("begin end");
});

test("a video that reaches the size limit ends and is saved", () => {
  const { store, save, filming: each } = filming();
  each.toggle();
  const large = { size: LARGEST_BYTES } as Blob;
  vi.stubGlobal(
    "Blob",
    class {
      readonly size = 1;
    },
  );
  FakeRecorder.newest.ondataavailable({ data: large });
  vi.unstubAllGlobals();
  expect(store.get().filming).toBe(false);
  expect(store.get().notices[0]?.sentence).toMatch(/reached its maximum size/);
  expect(save).toHaveBeenCalledOnce();
});

test("a browser that cannot record reports it", () => {
  vi.stubGlobal("MediaRecorder", undefined);
  const { store, filming: each } = filming();
  each.toggle();
  expect(store.get().filming).toBe(false);
  expect(store.get().notices[0]?.sentence).toBe("This browser cannot record video.");
});
