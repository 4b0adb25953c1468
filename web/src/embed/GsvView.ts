// <gsv-view src="http://HOST:PORT/">: the view of a running simulation or a recording in any page.
// The server draws it, so the page needs no WebGL and no permission for a WebSocket. The element is
// one file, /gsv-view.js; docs/viewer.md describes the attributes.
import type { Side } from "./camera";
import { FIRST_SIDE, PLACING, imageUrl, turned, zoomed } from "./camera";

const ATTRIBUTES = ["src", "simulation", "eye", "target", "follow", "camera", "fov", "quality", "fps", "token", "label"] as const;
// While the user moves the camera, the page requests single images. A stream starts this long after
// the camera's last movement.
const STEADY_MS = 400;
const RETRY_MS = 2000;
const SIDES_PX: [number, number] = [16, 4096]; // minimum and maximum side of an image, as in the server
const KEY_STEP_PX = 25;
const ZOOM_STEP = 1.2;

const STYLE = `
  :host { display: block; position: relative; aspect-ratio: 16 / 9; overflow: hidden; background: #b3bfcc; }
  :host([hidden]) { display: none; }
  img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; }
  .frame { position: absolute; inset: 0; touch-action: none; cursor: grab; }
  .frame:focus-visible { outline: 3px solid #2f81f7; outline-offset: -3px; }
  .frame.fixed { cursor: default; touch-action: auto; }
  p { position: absolute; inset: auto 0 0 0; margin: 0; padding: 6px 10px; background: #ffffffe6; color: #1b2733; font: 14px/1.4 sans-serif; }
`;

export class GsvView extends HTMLElement {
  static readonly observedAttributes = ATTRIBUTES;
  private readonly image = document.createElement("img");
  private readonly frame = document.createElement("div");
  private readonly status = document.createElement("p");
  private readonly sizes = new ResizeObserver(() => this.refresh());
  private side: Side = FIRST_SIDE;
  private grip: { x: number; y: number } | null = null;
  private isLoading = false; // whether a single image is being loaded
  private isStale = false; // whether the shown image is of an earlier camera
  private steady: ReturnType<typeof setTimeout> | undefined;
  private retry: ReturnType<typeof setTimeout> | undefined;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    const style = document.createElement("style");
    style.textContent = STYLE;
    this.image.alt = "";
    this.image.draggable = false;
    this.image.addEventListener("load", () => this.loaded());
    this.image.addEventListener("error", () => this.failed());
    this.frame.className = "frame";
    this.frame.tabIndex = 0;
    this.frame.setAttribute("role", "img");
    this.status.hidden = true;
    this.status.setAttribute("role", "status");
    this.frame.append(this.image);
    root.append(style, this.frame, this.status);
    this.listen();
  }

  connectedCallback(): void {
    this.sizes.observe(this);
    this.refresh();
  }

  disconnectedCallback(): void {
    this.sizes.disconnect();
    clearTimeout(this.steady);
    clearTimeout(this.retry);
    this.image.removeAttribute("src"); // without an address, the browser ends the stream
  }

  attributeChangedCallback(): void {
    if (this.isConnected) this.refresh();
  }

  // The direction from which the camera looks, in degrees.
  get view(): Side {
    return { ...this.side };
  }

  set view(side: Side) {
    this.side = { ...FIRST_SIDE, ...side };
    this.moved();
  }

  private get isFixed(): boolean {
    return PLACING.some((name) => this.getAttribute(name));
  }

  private listen(): void {
    const { frame } = this;
    frame.addEventListener("pointerdown", (event) => {
      if (this.isFixed || event.button !== 0) return;
      this.grip = { x: event.clientX, y: event.clientY };
      frame.setPointerCapture(event.pointerId);
    });
    frame.addEventListener("pointermove", ({ clientX: x, clientY: y }) => {
      if (!this.grip) return;
      this.view = turned(this.side, x - this.grip.x, y - this.grip.y);
      this.grip = { x, y };
    });
    for (const end of ["pointerup", "pointercancel"]) frame.addEventListener(end, () => (this.grip = null));
    frame.addEventListener(
      "wheel",
      (event) => {
        if (this.isFixed) return;
        event.preventDefault();
        this.view = zoomed(this.side, event.deltaY < 0 ? ZOOM_STEP : 1 / ZOOM_STEP);
      },
      { passive: false },
    );
    frame.addEventListener("dblclick", () => this.isFixed || (this.view = FIRST_SIDE));
    frame.addEventListener("keydown", (event) => {
      const side = this.isFixed ? null : sideAfter(event.key, this.side);
      if (!side) return;
      event.preventDefault();
      this.view = side;
    });
  }

  // Requests a new stream, because the attributes have changed.
  private refresh(): void {
    clearTimeout(this.retry);
    const label = this.getAttribute("label") || "View of the simulation";
    this.frame.setAttribute("aria-label", this.isFixed ? label : `${label}. Arrow keys turn the view, plus and minus zoom.`);
    this.frame.classList.toggle("fixed", this.isFixed);
    this.isLoading = false;
    this.show("view.mjpeg");
  }

  // While the camera moves, requests single images. The next image is requested only when the
  // previous one has arrived. So the requests cannot queue up and delay the images.
  private moved(): void {
    clearTimeout(this.steady);
    this.steady = setTimeout(() => this.refresh(), STEADY_MS);
    this.isStale = true;
    if (!this.isLoading) this.showNext();
  }

  private showNext(): void {
    this.isStale = false;
    this.isLoading = true;
    this.show("view.jpg");
  }

  private show(name: "view.jpg" | "view.mjpeg"): void {
    const src = this.getAttribute("src");
    const [width, height] = [this.clientWidth, this.clientHeight].map((side) =>
      Math.round(Math.min(SIDES_PX[1], Math.max(SIDES_PX[0], side))),
    ) as [number, number];
    if (!src) return this.say('Set the attribute src to the address of the viewer, such as "http://localhost:8080/".');
    const attributes = Object.fromEntries(ATTRIBUTES.map((each) => [each, this.getAttribute(each)]));
    try {
      const wanted = { src: new URL(src, document.baseURI).href, attributes, side: this.side, width, height };
      this.image.src = imageUrl(name, wanted);
    } catch {
      this.say(`The address "${src}" is not valid.`);
    }
  }

  private loaded(): void {
    this.say("");
    this.dispatchEvent(new CustomEvent("image"));
    if (!this.isLoading) return;
    this.isLoading = false;
    if (this.isStale) this.showNext();
  }

  private failed(): void {
    if (!this.image.hasAttribute("src")) return;
    this.isLoading = false;
    this.say(`The view of ${this.getAttribute("src")} cannot be loaded. The page tries again.`);
    clearTimeout(this.retry);
    this.retry = setTimeout(() => this.refresh(), RETRY_MS);
  }

  private say(sentence: string): void {
    this.status.hidden = sentence === "";
    if (this.status.textContent !== sentence) this.status.textContent = sentence;
  }
}

function sideAfter(key: string, side: Side): Side | null {
  switch (key) {
    case "ArrowLeft":
      return turned(side, KEY_STEP_PX, 0);
    case "ArrowRight":
      return turned(side, -KEY_STEP_PX, 0);
    case "ArrowUp":
      return turned(side, 0, KEY_STEP_PX);
    case "ArrowDown":
      return turned(side, 0, -KEY_STEP_PX);
    case "+":
      return zoomed(side, ZOOM_STEP);
    case "-":
      return zoomed(side, 1 / ZOOM_STEP);
    case "Home":
      return FIRST_SIDE;
    default:
      return null;
  }
}
