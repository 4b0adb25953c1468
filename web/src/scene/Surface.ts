// The surface that shows the view: the canvas of the browser's renderer, or the images of the
// server. The canvas is resized just before a frame is drawn, because a resized canvas is empty
// until then.
import type { Object3D, PerspectiveCamera, Scene } from "three";
import type { DrawnView } from "../view/DrawnView";
import type { AmbientOcclusion } from "./AmbientOcclusion";
import { pngOf, videoOf } from "./capture";
import { Quality } from "./Quality";
import type { ViewRenderer } from "./renderer";

export class Surface {
  width = 1; // width in CSS pixels
  height = 1;
  private drawn: DrawnView | null = null; // not null: the server draws the images
  private readonly quality: Quality;
  private isResized = false; // whether the size has changed since the last frame

  constructor(
    private readonly renderer: ViewRenderer,
    fixedQuality: boolean,
    private readonly occlusion: AmbientOcclusion | null = null,
  ) {
    this.quality = new Quality(devicePixelRatio, fixedQuality, occlusion !== null);
  }

  // The canvas that receives the pointer.
  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  get isDrawnByServer(): boolean {
    return this.drawn !== null;
  }

  // The number of images from the server so far; null while the browser draws.
  get images(): number | null {
    return this.drawn?.images ?? null;
  }

  // The server's image that is shown; null: there is none, or the browser draws.
  get drawnImage(): DrawnView["shown"] {
    return this.drawn?.shown ?? null;
  }

  get imageDelaysMs(): readonly number[] {
    return this.drawn?.delaysMs ?? [];
  }

  get pixelRatio(): number {
    return this.renderer.getPixelRatio();
  }

  // Shows images from the server from now on. With null, the browser draws again. Calls `onImage`
  // when there is a new image.
  drawBy(drawn: DrawnView | null, onImage: () => void): void {
    this.drawn?.dispose();
    this.drawn = drawn;
    if (!drawn) return;
    drawn.onNewImage = onImage;
    this.canvas.after(drawn.canvas);
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.isResized = true;
  }

  // Makes the next frame draw the shadows again.
  renewShadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  // Takes the time that a frame has taken. Returns true if this changes the quality of the
  // next frame.
  frameTook(milliseconds: number): boolean {
    if (this.drawn) return false;
    const hasChanged = this.quality.frameTook(milliseconds);
    this.isResized ||= hasChanged;
    return hasChanged;
  }

  // If the server draws, takes its newest image for display. Call this at the beginning of a frame.
  advance(): void {
    this.drawn?.advance();
  }

  // Resizes the canvas if necessary. Call this before `render`.
  prepare(): void {
    if (!this.isResized) return;
    this.isResized = false;
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    this.renderer.setSize(this.width, this.height);
  }

  // Draws the scene. If the server draws the scene, shows the server's image, and draws only the
  // objects that `painted` returns over it.
  render(scene: Scene, camera: PerspectiveCamera, painted: () => Object3D[]): void {
    if (this.drawn) {
      this.drawn.show(camera, this.width, this.height);
      return this.drawn.paint(painted());
    }
    this.renderer.render(scene, camera);
    if (this.quality.hasOcclusion) this.occlusion?.darken(scene, camera);
  }

  // Returns the present image as PNG, with what `paint` draws on it.
  picture(paint: (context: CanvasRenderingContext2D) => void): Promise<Blob> {
    return pngOf(this.shown, paint);
  }

  video(): MediaStream {
    return videoOf(this.shown);
  }

  private get shown(): HTMLCanvasElement {
    return this.drawn?.canvas ?? this.canvas;
  }
}
