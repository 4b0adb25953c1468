// Shows the view drawn by the server: its images on a separate canvas, with the page's overlays on
// top. The canvas lies over the one that receives the pointer, and does not block it.
import type { Object3D, PerspectiveCamera } from "three";
import { Vector3 } from "three";
import type { FetchImage, ServerCamera } from "./ImageFeed";
import { ImageFeed, queryOf } from "./ImageFeed";
import { OverlayPainter } from "./OverlayPainter";

export interface DrawnViewEvents {
  onImage(): void;
  onProblem(sentence: string): void;
}

const LARGEST_SIDE_PX = 4096;
const MOST_PX = 3840 * 2160; // the server's limits
const SMALLEST_SIDE_PX = 16;
const MOST_CAMERAS = 200; // while no image comes

export class DrawnView {
  readonly canvas = document.createElement("canvas");
  private readonly feed: ImageFeed;
  private readonly cameras = new Map<string, PerspectiveCamera>(); // of requests under way
  private overlays: readonly Object3D[] = [];
  private latest: { image: ImageBitmap; camera: PerspectiveCamera } | null = null;

  constructor(
    fetchImage: FetchImage,
    private readonly events: DrawnViewEvents,
  ) {
    this.canvas.className = "drawn-view";
    this.canvas.setAttribute("aria-hidden", "true"); // the canvas below it has the name
    this.feed = new ImageFeed(fetchImage, {
      onImage: (image, camera) => void this.take(image, camera),
      onProblem: (sentence) => events.onProblem(sentence),
    });
  }

  get images(): number {
    return this.feed.images;
  }

  // Shows this camera's images in an area of this size in CSS pixels. The camera is read again only
  // at the next call.
  show(camera: PerspectiveCamera, width: number, height: number, overlays: readonly Object3D[]): void {
    this.overlays = overlays;
    const wanted = serverCameraOf(camera, width, height, devicePixelRatio);
    const query = queryOf(wanted);
    if (!this.cameras.has(query)) this.cameras.set(query, camera.clone());
    if (this.cameras.size > MOST_CAMERAS) this.cameras.delete(this.cameras.keys().next().value!);
    this.feed.show(wanted);
    if (this.latest) this.paint();
  }

  dispose(): void {
    this.feed.end();
    this.canvas.remove();
    this.latest?.image.close();
  }

  private async take(blob: Blob, of: ServerCamera): Promise<void> {
    const image = await createImageBitmap(blob);
    const query = queryOf(of);
    const camera = this.cameras.get(query);
    if (!camera) return image.close();
    // Earlier entries belong to images that will not arrive any more.
    for (const known of this.cameras.keys()) {
      if (known === query) break;
      this.cameras.delete(known);
    }
    this.latest?.image.close();
    this.latest = { image, camera };
    this.paint();
    this.events.onImage();
  }

  private paint(): void {
    const { image, camera } = this.latest!;
    const context = this.canvas.getContext("2d");
    if (!context) return;
    if (this.canvas.width !== image.width || this.canvas.height !== image.height) {
      this.canvas.width = image.width;
      this.canvas.height = image.height;
    }
    context.drawImage(image, 0, 0);
    new OverlayPainter(context, image.width, image.height, camera).paint(this.overlays);
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
  const target = camera.getWorldDirection(new Vector3()).add(eye);
  return {
    eye: eye.toArray(),
    target: target.toArray(),
    fieldOfViewDeg: camera.fov,
    width: side(width),
    height: side(height),
  };
}
