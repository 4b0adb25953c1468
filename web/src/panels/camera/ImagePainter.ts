// Paints the images of one camera. One image is decoded at a time. If several images arrive during
// decoding, only the newest of them is decoded next.
import type { ValueImage } from "../../live/valueImage";
import type { CameraImage, DrawnValues } from "../../protocol/forms";
import { seconds } from "../../protocol/messages";

export interface Painted {
  time: number; // s, simulated
  values: ValueImage | null; // null if the pixels are colours
}

export class ImagePainter {
  private next: CameraImage | null = null;
  private busy = false;
  private isPainted = false;
  private generation = 0;
  // The CPU draws this canvas. The browser's graphics draw the 3D view. Without a graphics card,
  // this takes long, and a canvas that uses the same graphics would have to wait for it.
  private readonly context: CanvasRenderingContext2D | null;

  // `onProblem` gets a sentence if an image cannot be shown.
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly onPainted: (painted: Painted) => void,
    private readonly onProblem: (sentence: string) => void,
  ) {
    this.context = canvas.getContext("2d", { willReadFrequently: true });
  }

  clear(): void {
    this.generation += 1;
    this.next = null;
    // Do not use the canvas earlier, because its first call waits until the browser has started to
    // draw.
    if (this.isPainted) this.context?.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.isPainted = false;
  }

  take(image: CameraImage): void {
    this.next = image;
    if (!this.busy) void this.paintAll();
  }

  private async paintAll(): Promise<void> {
    this.busy = true;
    while (this.next) {
      const image = this.next;
      this.next = null;
      const problem = await this.paint(image, this.generation);
      if (problem !== "") this.onProblem(problem);
    }
    this.busy = false;
  }

  // Returns a sentence about the problem, or an empty text.
  private async paint(image: CameraImage, generation: number): Promise<string> {
    if ("problem" in image) return image.problem;
    if ("values" in image) {
      this.paintValues(image);
      return "";
    }
    const type = image.format.includes("png") ? "image/png" : "image/jpeg";
    // The data are copied, because the connection reuses the memory of the message.
    const blob = new Blob([image.data.slice()], { type });
    const bitmap = await createImageBitmap(blob).catch(() => null);
    if (!bitmap) return `The image cannot be decoded (format ${image.format}).`;
    if (generation !== this.generation) return "";
    this.canvas.width = bitmap.width;
    this.canvas.height = bitmap.height;
    this.context?.drawImage(bitmap, 0, 0);
    this.isPainted = true;
    bitmap.close();
    this.onPainted({ time: seconds(image.header.stamp), values: null });
    return "";
  }

  private paintValues({ values, pixels: { width, height, rgba }, header }: DrawnValues): void {
    this.canvas.width = width;
    this.canvas.height = height;
    this.context?.putImageData(new ImageData(rgba, width, height), 0, 0);
    this.isPainted = true;
    this.onPainted({ time: seconds(header.stamp), values });
  }
}
