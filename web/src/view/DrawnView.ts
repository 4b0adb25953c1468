// Shows the view that the server draws. The images are on a separate canvas, with the page's
// overlays on top. This canvas lies over the canvas that receives the pointer, and does not block
// the pointer.
import type { Object3D, PerspectiveCamera } from "three";
import { Vector3 } from "three";
import type { LiveViewSource } from "../protocol/LiveViews";
import type { ArrivedImage, Feed, FetchImage, ServerCamera } from "./ImageFeed";
import type { ImageDepths } from "./ImageDepths";
import { depthsOf, depthSpacing } from "./ImageDepths";
import { ImageFeed, queryOf } from "./ImageFeed";
import { OverlayPainter } from "./OverlayPainter";
import { PushedFeed } from "./PushedFeed";

export interface ImageSources {
  live: LiveViewSource; // pushes images
  fetchImage: FetchImage; // requests an image from a server that does not push images
}

export interface DrawnViewEvents {
  onImage(): void;
  onProblem(sentence: string): void;
  // Called if the server does not push images. The page must then request each image.
  onNotPushed(): void;
}

const LARGEST_SIDE_PX = 4096;
const MOST_PX = 3840 * 2160; // the server's limit
const SMALLEST_SIDE_PX = 16;
const MAX_CAMERAS = 200; // maximum number of stored cameras while no image arrives
const KEPT_DELAYS = 1000;
// m: distance from the eye to the target in a request. Requests round both points to 0.1 mm. With a
// near target, rounding would change the camera's direction, and a map would turn, because it is
// seen almost straight from above.
const AHEAD = 1000;

interface DecodedImage {
  bitmap: ImageBitmap;
  camera: PerspectiveCamera;
  arrived: ArrivedImage;
  depths: ImageDepths | null;
}

export class DrawnView {
  readonly canvas = document.createElement("canvas");
  images = 0; // number of images so far
  // The delays of the server's last images in ms, from the time at which the server saw a state of
  // the world until its image was on the screen. Correct only if the clocks of both computers
  // agree.
  readonly delaysMs: number[] = [];
  // Called when advance() can show another image.
  onNewImage = () => {};
  private feed: Feed;
  // Cameras of the images that have been requested.
  private readonly cameras = new Map<string, PerspectiveCamera>();
  private wanted: ServerCamera | null = null;
  private waiting: ArrivedImage | null = null; // the newest image that is not decoded yet
  private isDecoding = false;
  private isDisposed = false;
  private next: DecodedImage | null = null;
  private present: DecodedImage | null = null; // the image that is shown

  constructor(
    sources: ImageSources,
    private readonly events: DrawnViewEvents,
  ) {
    this.canvas.className = "drawn-view";
    // the other canvas, which is below this one, has the accessible name
    this.canvas.setAttribute("aria-hidden", "true");
    const taken = {
      onImage: (image: ArrivedImage) => this.take(image),
      onProblem: (sentence: string) => events.onProblem(sentence),
    };
    this.feed = new PushedFeed(sources.live, {
      ...taken,
      onNotOffered: () => {
        events.onNotPushed();
        this.feed = new ImageFeed(sources.fetchImage, taken);
        if (this.wanted) this.feed.show(this.wanted);
      },
    });
  }

  // The camera of the image that is shown, and the image's simulated time in seconds (null if
  // unknown). Null if there is no image yet.
  get shown(): { camera: PerspectiveCamera; stamp: number | null } | null {
    return this.present && { camera: this.present.camera, stamp: this.present.arrived.stamp };
  }

  // Shows the newest image. Call this at the beginning of a frame, so that the same camera is used
  // for everything that belongs to the image.
  advance(): void {
    if (!this.next) return;
    this.present?.bitmap.close();
    this.present = this.next;
    this.next = null;
    this.report(this.present.arrived);
  }

  // Requests images of this camera in an area of this size in CSS pixels. If the camera moves, call
  // show() again.
  show(camera: PerspectiveCamera, width: number, height: number): void {
    this.wanted = serverCameraOf(camera, width, height, devicePixelRatio);
    const query = queryOf(this.wanted);
    if (!this.cameras.has(query)) this.cameras.set(query, camera.clone());
    if (this.cameras.size > MAX_CAMERAS) this.cameras.delete(this.cameras.keys().next().value!);
    this.feed.show(this.wanted);
  }

  // Paints the present image with these overlays.
  paint(overlays: readonly Object3D[]): void {
    const context = this.present && this.canvas.getContext("2d", { alpha: false });
    if (!this.present || !context) return;
    const { bitmap, camera, depths } = this.present;
    const { width, height } = this.present.arrived.camera;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    context.drawImage(bitmap, 0, 0, width, height);
    new OverlayPainter(context, width, height, camera, depths).paint(overlays);
  }

  dispose(): void {
    this.isDisposed = true;
    this.feed.end();
    this.canvas.remove();
    for (const image of [this.next, this.present]) image?.bitmap.close();
    this.next = this.present = null;
  }

  private take(image: ArrivedImage): void {
    // The previous image is skipped. The server sends the next image only after shown().
    this.waiting?.shown();
    this.waiting = image;
    if (!this.isDecoding) void this.decode();
  }

  private async decode(): Promise<void> {
    this.isDecoding = true;
    while (this.waiting) {
      const arrived = this.waiting;
      this.waiting = null;
      const bitmap = await createImageBitmap(new Blob([arrived.jpeg], { type: "image/jpeg" })).catch(() => null);
      if (this.isDisposed) return bitmap?.close();
      const camera = this.cameraOf(arrived.camera);
      if (!bitmap || !camera) {
        bitmap?.close();
        arrived.shown();
        continue;
      }
      if (this.next) {
        this.next.bitmap.close(); // the previous image is skipped
        this.next.arrived.shown();
      }
      this.next = { bitmap, camera, arrived, depths: depthsOf(arrived.jpeg) };
      this.images += 1;
      this.onNewImage();
      this.events.onImage();
    }
    this.isDecoding = false;
  }

  private cameraOf(of: ServerCamera): PerspectiveCamera | null {
    const query = queryOf(of);
    const camera = this.cameras.get(query);
    if (!camera) return null;
    // Earlier entries belong to images that will not arrive any more.
    for (const known of this.cameras.keys()) {
      if (known === query) break;
      this.cameras.delete(known);
    }
    return camera;
  }

  private report({ seenMs, shown }: ArrivedImage): void {
    if (seenMs !== null) this.delaysMs.push(Date.now() - seenMs);
    if (this.delaysMs.length > KEPT_DELAYS) this.delaysMs.shift();
    shown();
  }
}

export function serverCameraOf(camera: PerspectiveCamera, width: number, height: number, pixelRatio: number): ServerCamera {
  const ratio = Math.min(
    pixelRatio,
    LARGEST_SIDE_PX / Math.max(width, height),
    Math.sqrt(MOST_PX / (width * height)),
  );
  const side = (pixels: number) => Math.max(SMALLEST_SIDE_PX, Math.floor(pixels * ratio));
  const eye = camera.getWorldPosition(new Vector3());
  const target = camera.getWorldDirection(new Vector3()).multiplyScalar(AHEAD).add(eye);
  const [imageWidth, imageHeight] = [side(width), side(height)];
  return {
    eye: eye.toArray(),
    target: target.toArray(),
    fieldOfViewDeg: camera.fov,
    width: imageWidth,
    height: imageHeight,
    depthSpacing: depthSpacing(imageWidth, imageHeight),
  };
}
