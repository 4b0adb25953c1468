// Selects several bodies: with Shift or Ctrl, a click adds a body to the selection or removes it,
// and a drag selects all bodies in a rectangle.
import type { ScreenPlace } from "./picking";

const DRAG_PX = 5;

export interface RectangleEvents {
  onAdd(at: ScreenPlace): void;
  onChoose(isInside: (at: ScreenPlace) => boolean): void;
}

export class RectangleChoice {
  isOn = false;
  private readonly mark = document.createElement("div");
  private from: ScreenPlace | null = null;
  private isDrag = false;

  constructor(
    private readonly host: HTMLElement,
    private readonly events: RectangleEvents,
  ) {
    this.mark.className = "choice-rectangle";
    this.mark.hidden = true;
    host.append(this.mark);
    // These listeners see each event first (they capture it). So they can keep the drag of a
    // rectangle from the camera's gestures.
    host.addEventListener("pointerdown", (event) => this.begin(event), true);
    host.addEventListener("pointermove", (event) => this.draw(event), true);
    host.addEventListener("pointerup", (event) => this.end(event), true);
    host.addEventListener("pointercancel", () => this.giveUp(), true);
  }

  private begin(event: PointerEvent): void {
    if (!this.isOn || !event.isPrimary || event.button !== 0 || !isAdding(event)) return;
    if (!(event.target instanceof HTMLCanvasElement)) return;
    event.stopPropagation();
    this.from = { x: event.clientX, y: event.clientY };
    this.isDrag = false;
    this.host.setPointerCapture(event.pointerId);
  }

  private draw(event: PointerEvent): void {
    const { from } = this;
    if (!from) return;
    event.stopPropagation();
    this.isDrag ||= Math.hypot(event.clientX - from.x, event.clientY - from.y) > DRAG_PX;
    if (!this.isDrag) return;
    const { left, top } = this.host.getBoundingClientRect();
    this.mark.hidden = false;
    Object.assign(this.mark.style, {
      left: `${Math.min(from.x, event.clientX) - left}px`,
      top: `${Math.min(from.y, event.clientY) - top}px`,
      width: `${Math.abs(event.clientX - from.x)}px`,
      height: `${Math.abs(event.clientY - from.y)}px`,
    });
  }

  private end(event: PointerEvent): void {
    const { from, isDrag } = this;
    if (!from) return;
    event.stopPropagation();
    this.giveUp();
    const to = { x: event.clientX, y: event.clientY };
    if (!isDrag) return this.events.onAdd(from);
    const [left, right] = [Math.min(from.x, to.x), Math.max(from.x, to.x)];
    const [top, bottom] = [Math.min(from.y, to.y), Math.max(from.y, to.y)];
    this.events.onChoose(({ x, y }) => x >= left && x <= right && y >= top && y <= bottom);
  }

  private giveUp(): void {
    this.from = null;
    this.mark.hidden = true;
  }
}

export function isAdding(event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean }): boolean {
  return event.shiftKey || event.ctrlKey || event.metaKey;
}
