// A round pad that commands a motion when the user drags on it, or presses keys while the pad has
// the focus. The page does not receive these keys.
import { element } from "../../ui/element";
import type { Wish } from "./driving";
import { STILL, isDrivingKey, isStill, wishOfKeys, wishOfPoint } from "./driving";

// The knob's maximum distance from the centre, as a percentage of the pad's size.
const REACH_PERCENT = 35;

export class DrivingPad {
  private readonly knob = element("div", { class: "pad-knob" });
  readonly element = element("div", { class: "pad", tabindex: "0", role: "application", "aria-label": "Driving pad" }, this.knob);
  private readonly held = new Set<string>(); // keys that are held
  private pointed: Wish = STILL;

  constructor(private readonly onWish: (wish: Wish) => void) {
    const pad = this.element;
    pad.addEventListener("keydown", (event) => this.keyDown(event));
    pad.addEventListener("keyup", ({ key }) => {
      this.held.delete(key.toLowerCase());
      this.tell();
    });
    pad.addEventListener("blur", () => {
      this.letGo();
      this.tell();
    });
    pad.addEventListener("pointerdown", (event) => this.pointerDown(event));
    pad.addEventListener("pointermove", (event) => pad.hasPointerCapture(event.pointerId) && this.point(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      pad.addEventListener(end, () => {
        this.pointed = STILL;
        this.tell();
      });
    }
  }

  letGo(): void {
    this.held.clear();
    this.pointed = STILL;
    this.onWish(STILL);
  }

  show(wish: Wish): void {
    this.knob.style.transform = `translate(${-REACH_PERCENT * wish.turn}%, ${-REACH_PERCENT * wish.ahead}%)`;
    this.element.classList.toggle("driving", !isStill(wish));
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey || !isDrivingKey(event.key)) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat) return;
    this.held.add(event.key.toLowerCase());
    this.tell();
  }

  private pointerDown(event: PointerEvent): void {
    if (event.button !== 0) return;
    event.preventDefault();
    this.element.setPointerCapture(event.pointerId);
    this.element.focus({ preventScroll: true });
    this.point(event);
  }

  private point({ clientX, clientY }: PointerEvent): void {
    const { left, top, width, height } = this.element.getBoundingClientRect();
    const radius = Math.max(1, Math.min(width, height) / 2);
    this.pointed = wishOfPoint((clientX - left - width / 2) / radius, (clientY - top - height / 2) / radius);
    this.tell();
  }

  private tell(): void {
    const keys = wishOfKeys(this.held);
    this.onWish(isStill(keys) ? this.pointed : keys);
  }
}
