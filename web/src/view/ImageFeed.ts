// Fetches images that the server draws, one after another. It is for servers that do not push
// images. The next image is requested when the previous image has arrived. So a slow connection
// gets fewer images, but never old images.

// The camera in the server's form; lengths in metres, the size in pixels.
export interface ServerCamera {
  eye: readonly [number, number, number];
  target: readonly [number, number, number];
  fieldOfViewDeg: number; // vertical
  width: number;
  height: number;
  depthSpacing: number; // distance between the image's depths, in pixels; 0: the image has no depths
}

// An image that the server has sent.
export interface ArrivedImage {
  jpeg: Uint8Array<ArrayBuffer>;
  camera: ServerCamera; // the camera with which the image was drawn
  stamp: number | null; // s, simulated; null: unknown
  seenMs: number | null; // when the server first saw this state, in ms since 1970; null: unknown
  // Call this when the image is on the screen, or was skipped.
  shown(): void;
}

export interface FeedEvents {
  onImage(image: ArrivedImage): void;
  // Called with the reason if the server draws no images. The feed has then ended.
  onProblem(sentence: string): void;
}

// A source of images. It shows the images of the latest camera.
export interface Feed {
  show(camera: ServerCamera): void;
  end(): void;
}

export type FetchImage = (query: string, signal: AbortSignal) => Promise<Response>;

export const RETRY_MS = 1000;
// Number of consecutive failures that are allowed. For example, requests fail while the server
// restarts.
export const TRIES = 3;

export class ImageFeed implements Feed {
  private wanted: ServerCamera | null = null;
  private shown = ""; // the camera of the last image, as a query
  private number = ""; // number of the last image
  private asking: AbortController | null = null;
  private failures = 0;
  private isEnded = false;
  private asked = ""; // the camera of the pending request, as a query
  // False after the server has refused a request for depths. For example, a relay may show the
  // simulation of an older server, which has no depths.
  private hasDepths = true;

  constructor(
    private readonly fetchImage: FetchImage,
    private readonly events: FeedEvents,
  ) {}

  // Requests this camera's images from now on.
  show(camera: ServerCamera): void {
    const isOther = this.wanted === null || queryOf(this.wanted) !== queryOf(camera);
    this.wanted = camera;
    if (this.isEnded || !isOther) return;
    // Aborts a request that waits for a change. A request whose image is being drawn is not
    // aborted.
    if (this.asking && this.number !== "" && this.shown === this.asked) this.asking.abort();
    else if (!this.asking) void this.ask();
  }

  end(): void {
    this.isEnded = true;
    this.asking?.abort();
  }

  private async ask(): Promise<void> {
    while (!this.isEnded && this.wanted) {
      const camera = this.wanted;
      this.asked = queryOf(camera);
      this.asking = new AbortController();
      const after = this.asked === this.shown && this.number !== "" ? `&after=${this.number}` : "";
      const problem = await this.take(camera, this.asked + after, this.asking.signal);
      if (this.isEnded) return;
      if (problem === null) {
        this.failures = 0;
      } else if (++this.failures >= TRIES) {
        this.isEnded = true;
        this.events.onProblem(problem);
      } else {
        await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
      }
    }
    this.asking = null;
  }

  // Requests and takes an image. Returns an error message for the user, or null if it succeeds.
  private async take(camera: ServerCamera, query: string, signal: AbortSignal): Promise<string | null> {
    try {
      const response = await this.fetchImage(this.hasDepths ? query : query.replace(/&depth=\d+/, ""), signal);
      if (response.status === 204) return null;
      if (response.status === 400 && this.hasDepths) {
        this.hasDepths = false; // the next request asks for no depths
        return null;
      }
      if (!response.ok) return await sentenceOf(response);
      const jpeg = new Uint8Array(await response.arrayBuffer());
      if (this.isEnded) return null;
      this.shown = queryOf(camera);
      this.number = (response.headers.get("etag") ?? "").replaceAll('"', "");
      this.events.onImage({ jpeg, camera, stamp: stampOf(response), seenMs: null, shown: () => {} });
      return null;
    } catch (error) {
      if (signal.aborted) return null;
      return `The server cannot be reached: ${(error as Error).message}`;
    }
  }
}

export function queryOf({ eye, target, fieldOfViewDeg, width, height, depthSpacing }: ServerCamera): string {
  const point = (place: readonly number[]) => place.map((value) => value.toFixed(4)).join(",");
  const depth = depthSpacing > 0 ? `&depth=${depthSpacing}` : "";
  return `size=${width}x${height}&eye=${point(eye)}&target=${point(target)}&fov=${fieldOfViewDeg.toFixed(3)}${depth}`;
}

function stampOf(response: Response): number | null {
  const stamp = response.headers.get("gsv-time");
  return stamp === null ? null : Number(stamp);
}

async function sentenceOf(response: Response): Promise<string> {
  const answer = (await response.json().catch(() => null)) as { error?: unknown } | null;
  return typeof answer?.error === "string" ? answer.error : `The server returned an error: ${response.status}.`;
}
