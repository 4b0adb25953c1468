// What the view is drawn on: the canvas of the browser's renderer, or the images of the server. It
// changes the size of the canvas just before a frame is drawn, because a canvas that gets another
// size is empty until then.
import type { Object3D, PerspectiveCamera, Scene } from "three";
import type { DrawnView } from "../view/DrawnView";
import type { AmbientOcclusion } from "./AmbientOcclusion";
import { pngOf, videoOf } from "./capture";
import { Quality } from "./Quality";
import type { ViewRenderer } from "./renderer";

export class Surface {
  width = 1; // CSS pixels
  height = 1;
  private drawn: DrawnView | null = null; // not null: the server draws
  private readonly quality: Quality;
  private isResized = false; // since the last frame

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

  // The number of images of the server so far; null while the browser draws.
  get images(): number | null {
    return this.drawn?.images ?? null;
  }

  // The image of the server that is shown; null: there is none, or the browser draws.
  get drawnImage(): DrawnView["shown"] {
    return this.drawn?.shown ?? null;
  }

  get imageDelaysMs(): readonly number[] {
    return this.drawn?.delaysMs ?? [];
  }

  get pixelRatio(): number {
    return this.renderer.getPixelRatio();
  }

  // Shows images of the server from now on; null: the browser draws. `onImage`: there is another
  // image to paint.
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

  // The shadows are drawn again with the next frame.
  renewShadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  // Takes the time between two consecutive frames. Returns true if the next frame is drawn in
  // another way.
  frameTook(milliseconds: number): boolean {
    if (this.drawn) return false;
    const hasChanged = this.quality.frameTook(milliseconds);
    this.isResized ||= hasChanged;
    return hasChanged;
  }

  // Goes to the newest image of the server, if it draws. Call this at the beginning of a frame.
  advance(): void {
    this.drawn?.advance();
  }

  // Brings the canvas to its size. Call this before `render`.
  prepare(): void {
    if (!this.isResized) return;
    this.isResized = false;
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    this.renderer.setSize(this.width, this.height);
  }

  // Draws the scene, or on the present image of the server only what is in `painted`.
  render(scene: Scene, camera: PerspectiveCamera, painted: () => Object3D[]): void {
    if (this.drawn) {
      this.drawn.show(camera, this.width, this.height);
      return this.drawn.paint(painted());
    }
    this.renderer.render(scene, camera);
    if (this.quality.hasOcclusion) this.occlusion?.darken(scene, camera);
  }

  // The present image as PNG, with what `paint` adds.
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
