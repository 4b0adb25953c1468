import { expect, test, vi } from "vitest";
import { ConnectedViews, SharedViews } from "../protocol/LiveViews";
import type { ArrivedImage, ServerCamera } from "./ImageFeed";
import { PushedFeed } from "./PushedFeed";

const CAMERA: ServerCamera = { eye: [1, 2, 3], target: [4, 5, 6], fieldOfViewDeg: 50, width: 640, height: 480, depthSpacing: 8 };
const QUERY = "size=640x480&eye=1.0000,2.0000,3.0000&target=4.0000,5.0000,6.0000&fov=50.000&depth=8&fps=30";
const other = (x: number): ServerCamera => ({ ...CAMERA, eye: [x, 2, 3] });

// The content of an image message, as docs/formats/live.md describes it.
function payload(sequence: number, number: number, seenUs: number): DataView {
  const view = new DataView(new ArrayBuffer(24));
  view.setUint32(0, sequence, true);
  view.setBigUint64(4, BigInt(number), true);
  view.setBigUint64(12, BigInt(seenUs), true);
  return view;
}

function fixture({ hidden = false } = {}) {
  const sent: Record<string, unknown>[] = [];
  let id = 6;
  const views = new ConnectedViews((message) => sent.push(message as Record<string, unknown>), () => ++id);
  const images: ArrivedImage[] = [];
  const events = { onImage: (image: ArrivedImage) => images.push(image), onProblem: vi.fn(), onNotOffered: vi.fn() };
  const feed = new PushedFeed(views, events, () => hidden);
  return { sent, views, images, events, feed, take: (...of: Parameters<typeof payload>) => views.takeMessage(7, 2_500_000_000n, payload(...of)) };
}

test("subscribes when the stream is open, and again with another camera", () => {
  const { sent, views, feed } = fixture();
  feed.show(CAMERA);
  expect(sent).toEqual([]);
  views.connected(true);
  expect(sent).toEqual([{ op: "gsvSubscribeView", id: 7, camera: QUERY, sequence: 1 }]);
  feed.show({ ...CAMERA });
  expect(sent).toHaveLength(1);
  feed.show(other(9));
  expect(sent.at(-1)).toMatchObject({ op: "gsvSubscribeView", id: 7, sequence: 2 });
  feed.end();
  expect(sent.at(-1)).toEqual({ op: "gsvUnsubscribeView", id: 7 });
});

test("an image comes with its camera and times, and is reported when it was shown", async () => {
  const { sent, views, feed, images, take } = fixture();
  views.connected(true);
  feed.show(CAMERA);
  feed.show(other(9));
  expect(take(1, 40, 1_700_000_000_123_000)).toBe(true);
  expect(images[0]).toMatchObject({ camera: CAMERA, stamp: 2.5, seenMs: 1_700_000_000_123 });
  expect(images[0]!.jpeg.length).toBe(4);
  expect(sent).toHaveLength(2);
  images[0]!.shown();
  await vi.waitFor(() => expect(sent.at(-1)).toEqual({ op: "gsvViewShown", id: 7, image: 40 }));
  take(2, 41, 0);
  expect(images[1]!.camera).toEqual(other(9));
});

test("an image of an unknown camera is left out", async () => {
  const { sent, views, feed, images, take } = fixture();
  views.connected(true);
  feed.show(CAMERA);
  take(5, 40, 0);
  await vi.waitFor(() => expect(sent.at(-1)).toEqual({ op: "gsvViewShown", id: 7, image: 40 }));
  expect(images).toEqual([]);
});

test("messages of other subscriptions are ignored, and a truncated image is an error", () => {
  const { views, feed } = fixture();
  views.connected(true);
  feed.show(CAMERA);
  expect(views.takeMessage(8, 0n, payload(1, 1, 1))).toBe(false);
  expect(() => views.takeMessage(7, 0n, new DataView(new ArrayBuffer(20)))).toThrow("cut off");
});

test("a lost connection and another simulation subscribe again", () => {
  const { sent, views } = fixture();
  const shared = new SharedViews();
  const feed = new PushedFeed(shared, { onImage: vi.fn(), onProblem: vi.fn(), onNotOffered: vi.fn() }, () => false);
  feed.show(CAMERA);
  shared.attach(views);
  views.connected(true);
  views.lost();
  views.connected(true);
  expect(sent.filter(({ op }) => op === "gsvSubscribeView").map(({ id }) => id)).toEqual([8, 8]);
  const later: object[] = [];
  const next = new ConnectedViews((message) => later.push(message), () => 3);
  shared.attach(next);
  expect(sent.at(-1)).toEqual({ op: "gsvUnsubscribeView", id: 8 });
  next.connected(true);
  expect(later).toMatchObject([{ op: "gsvSubscribeView", id: 3 }]);
});

test("a server without pushed images is reported once", () => {
  const { sent, views, feed, events } = fixture();
  feed.show(CAMERA);
  views.connected(false);
  views.connected(false);
  expect(events.onNotOffered).toHaveBeenCalledTimes(1);
  expect(sent).toEqual([]);
});

test("a view that the server ends is begun again, and its sentence shown after three times", () => {
  vi.useFakeTimers();
  const { sent, views, feed, events } = fixture();
  views.connected(true);
  feed.show(CAMERA);
  for (let i = 0; i < 3; i++) {
    views.takeFailure({ id: 7, message: "the server already draws 8 views" });
    vi.advanceTimersByTime(1000);
  }
  expect(sent.filter(({ op }) => op === "gsvSubscribeView")).toHaveLength(3);
  expect(events.onProblem).toHaveBeenCalledTimes(1);
  expect(events.onProblem).toHaveBeenCalledWith("the server already draws 8 views");
  vi.useRealTimers();
});

test("a hidden page reports no image as shown", async () => {
  vi.stubGlobal("document", new EventTarget());
  const { sent, views, feed, images, take } = fixture({ hidden: true });
  views.connected(true);
  feed.show(CAMERA);
  take(1, 40, 0);
  images[0]!.shown();
  await new Promise((resolve) => setTimeout(resolve));
  expect(sent).toHaveLength(1);
  vi.unstubAllGlobals();
});
