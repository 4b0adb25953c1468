import { expect, test, vi } from "vitest";
import type { ServerCamera } from "./ImageFeed";
import { ImageFeed } from "./ImageFeed";

const CAMERA: ServerCamera = { eye: [1, 2, 3], target: [4, 5, 6], fieldOfViewDeg: 50, width: 640, height: 480, depthSpacing: 8 };
const QUERY = "size=640x480&eye=1.0000,2.0000,3.0000&target=4.0000,5.0000,6.0000&fov=50.000&depth=8";

// A server that answers when the test requests it.
function fakeServer() {
  const asked: { query: string; signal: AbortSignal; answer: (response: Response) => void }[] = [];
  const fetchImage = (query: string, signal: AbortSignal) =>
    new Promise<Response>((resolve, reject) => {
      asked.push({ query, signal, answer: resolve });
      signal.addEventListener("abort", () => reject(new Error("aborted")));
    });
  return { asked, fetchImage };
}

const image = (number: number) => new Response(new Blob(["jpeg"]), { headers: { etag: `"${number}"` } });
const refusal = (status: number, error: string) => new Response(JSON.stringify({ error }), { status });

test("requests the next image when the last one has arrived, with its number", async () => {
  const { asked, fetchImage } = fakeServer();
  const onImage = vi.fn();
  const feed = new ImageFeed(fetchImage, { onImage, onProblem: vi.fn() });
  feed.show(CAMERA);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  expect(asked[0]!.query).toBe(QUERY);
  asked[0]!.answer(image(7));
  await vi.waitFor(() => expect(asked).toHaveLength(2));
  expect(onImage).toHaveBeenCalledTimes(1);
  expect(asked[1]!.query).toBe(`${QUERY}&after=7`);
  asked[1]!.answer(new Response(null, { status: 204 })); // nothing has changed
  await vi.waitFor(() => expect(asked).toHaveLength(3));
  expect(onImage).toHaveBeenCalledTimes(1);
  expect(asked[2]!.query).toBe(`${QUERY}&after=7`);
  feed.end();
});

test("a new camera ends the wait for a change, but not an image that is being drawn", async () => {
  const { asked, fetchImage } = fakeServer();
  const onImage = vi.fn();
  const feed = new ImageFeed(fetchImage, { onImage, onProblem: vi.fn() });
  feed.show(CAMERA);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  feed.show({ ...CAMERA, eye: [9, 9, 9] });
  expect(asked[0]!.signal.aborted).toBe(false);
  asked[0]!.answer(image(7));
  await vi.waitFor(() => expect(asked).toHaveLength(2));
  // The camera with which the image was drawn.
  expect(onImage.mock.calls[0]![0].camera).toEqual(CAMERA);
  expect(asked[1]!.query).toContain("eye=9.0000,9.0000,9.0000");
  expect(asked[1]!.query).not.toContain("after");
  asked[1]!.answer(image(7));
  await vi.waitFor(() => expect(asked).toHaveLength(3));
  feed.show(CAMERA);
  expect(asked[2]!.signal.aborted).toBe(true);
  await vi.waitFor(() => expect(asked).toHaveLength(4));
  expect(asked[3]!.query).toBe(QUERY);
  feed.end();
});

test("reports the server's sentence after three failures, and ends", async () => {
  vi.useFakeTimers();
  const onProblem = vi.fn();
  const fetchImage = vi.fn(async () => refusal(503, "the server draws 8 views already"));
  new ImageFeed(fetchImage, { onImage: vi.fn(), onProblem }).show(CAMERA);
  await vi.advanceTimersByTimeAsync(5000);
  expect(fetchImage).toHaveBeenCalledTimes(3);
  expect(onProblem).toHaveBeenCalledWith("the server draws 8 views already");
  await vi.advanceTimersByTimeAsync(5000);
  expect(fetchImage).toHaveBeenCalledTimes(3);
  vi.useRealTimers();
});

test("a server that knows no depths is asked again without them", async () => {
  const { asked, fetchImage } = fakeServer();
  const onImage = vi.fn();
  const feed = new ImageFeed(fetchImage, { onImage, onProblem: vi.fn() });
  feed.show(CAMERA);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  asked[0]!.answer(refusal(400, "there is no parameter 'depth'"));
  await vi.waitFor(() => expect(asked).toHaveLength(2));
  expect(asked[1]!.query).toBe(QUERY.replace("&depth=8", ""));
  asked[1]!.answer(image(1));
  await vi.waitFor(() => expect(onImage).toHaveBeenCalled());
  feed.end();
});
