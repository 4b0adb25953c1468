// Shows that the label under the pointer can be clicked.
import type { LabelLayer } from "./LabelLayer";

export class LabelHover {
  // Position of the pointer, in CSS pixels of the view. Null if the pointer is elsewhere, if it is a
  // touch, or while a button is pressed.
  private pointer: { x: number; y: number } | null = null;

  // `canvas` receives the pointer and covers the view.
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly labels: LabelLayer,
  ) {
    canvas.addEventListener("pointermove", ({ pointerType, buttons, offsetX: x, offsetY: y }) => {
      this.pointer = pointerType === "touch" || buttons !== 0 ? null : { x, y };
      this.update();
    });
    canvas.addEventListener("pointerleave", () => {
      this.pointer = null;
      this.update();
    });
  }

  // Call this when labels have moved.
  update(): void {
    const isOnLabel = this.pointer !== null && this.labels.at(this.pointer.x, this.pointer.y) !== null;
    this.canvas.classList.toggle("on-label", isOnLabel);
  }
}
