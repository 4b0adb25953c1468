// Receives the images that the server pushes over the live stream. The server sends the next image
// when the previous image has been shown. So a slow connection gets fewer images, but never old
// images.
import type { LiveView, LiveViewSource, PushedImage } from "../protocol/LiveViews";
import type { Feed, FeedEvents, ServerCamera } from "./ImageFeed";
import { RETRY_MS, TRIES, queryOf } from "./ImageFeed";

const FRAMES_PER_SECOND = 30; // maximum rate
const MAX_CAMERAS = 200; // maximum number of stored cameras while no image arrives

export interface PushedEvents extends FeedEvents {
  // Called if the server pushes no images. The feed has then ended.
  onNotOffered(): void;
}

export class PushedFeed implements Feed {
  private readonly view: LiveView;
  private readonly cameras = new Map<number, ServerCamera>(); // by sequence number
  private wanted: ServerCamera | null = null;
  private sequence = 0;
  private isReady = false;
  private isEnded = false;
  private failures = 0; // number of consecutive failures
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    source: LiveViewSource,
    private readonly events: PushedEvents,
    private readonly isHidden: () => boolean = () => document.hidden,
  ) {
    this.view = source.openView({
      onReady: (isOffered) => this.ready(isOffered),
      onImage: (image) => this.take(image),
      onEnd: (sentence) => this.fail(sentence),
    });
  }

  show(camera: ServerCamera): void {
    const isOther = this.wanted === null || queryOf(this.wanted) !== queryOf(camera);
    this.wanted = camera;
    if (isOther && this.isReady) this.request();
  }

  end(): void {
    this.isEnded = true;
    clearTimeout(this.timer);
    this.view.end();
  }

  private ready(isOffered: boolean): void {
    if (this.isEnded) return;
    if (!isOffered) {
      this.end();
      return this.events.onNotOffered();
    }
    this.isReady = true;
    this.cameras.clear();
    if (this.wanted) this.request();
  }

  private request(): void {
    if (this.timer !== undefined) return; // the next attempt is already scheduled
    this.sequence += 1;
    this.cameras.set(this.sequence, this.wanted!);
    if (this.cameras.size > MAX_CAMERAS) this.cameras.delete(this.cameras.keys().next().value!);
    this.view.show(`${queryOf(this.wanted!)}&fps=${FRAMES_PER_SECOND}`, this.sequence);
  }

  private take(image: PushedImage): void {
    if (this.isEnded) return;
    this.failures = 0;
    const shown = () => void whenVisible(this.isHidden).then(() => this.isEnded || this.view.shown(image));
    const camera = this.cameras.get(image.sequence);
    if (!camera) return shown();
    // Earlier cameras belong to images that will never arrive.
    for (const known of this.cameras.keys()) {
      if (known === image.sequence) break;
      this.cameras.delete(known);
    }
    this.events.onImage({ jpeg: image.jpeg, camera, stamp: image.stamp, seenMs: image.seenMs, shown });
  }

  private fail(sentence: string): void {
    if (this.isEnded) return;
    if (++this.failures >= TRIES) {
      this.end();
      return this.events.onProblem(sentence);
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = undefined;
      if (this.wanted) this.request();
    }, RETRY_MS);
  }
}

// Resolves when the page is visible, because a page in the background needs no images.
async function whenVisible(isHidden: () => boolean): Promise<void> {
  while (isHidden()) {
    await new Promise((resolve) => document.addEventListener("visibilitychange", resolve, { once: true }));
  }
}
