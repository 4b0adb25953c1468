// One camera: its newest image with the time of the image. If the image is late, also shows its
// age. Depth images also have a colour scale and show the value under the pointer.
import type { CameraChoice } from "../../api/scene";
import type { ValueImage } from "../../live/valueImage";
import { SCALE_CSS, spanOf } from "../../live/valueImage";
import type { CameraImage } from "../../protocol/forms";
import { element, setText } from "../../ui/element";
import { formatTime, formatValue } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";
import { ImagePainter } from "./ImagePainter";

const SAME_INSTANT_S = 1e-6;
const BEHIND_S = 1.5; // the age of an image is shown if it is at least this, s
const MIN_ZOOM = 1;
const MAX_ZOOM = 16;
const ZOOM_STEP = 1.25;

export class CameraTile {
  readonly element: HTMLElement;
  private readonly picture = element("canvas", { class: "picture", role: "img" });
  private readonly caption = element("span", { class: "picture-time number" });
  private readonly waiting = element("p", { class: "picture-waiting" });
  private readonly value = element("output", { class: "picture-value number" });
  private readonly least = element("span", { class: "number" });
  private readonly largest = element("span", { class: "number" });
  private readonly scale = element("div", { class: "picture-scale", hidden: true });
  private readonly painter: ImagePainter;
  private values: ValueImage | null = null;
  private shownTime = -Infinity; // time of the shown image, s
  private end = () => {};
  private zoom = 1;

  constructor(
    readonly camera: CameraChoice,
    private readonly ports: Pick<PanelPorts, "state" | "topics">,
    label: string,
  ) {
    this.picture.setAttribute("aria-label", label);
    this.picture.width = this.picture.height = 1;
    const bar = element("span", { class: "picture-scale-bar" });
    bar.style.background = SCALE_CSS;
    this.scale.append(this.least, bar, this.largest);
    const frame = element("div", { class: "picture-zoom" }, this.picture);
    this.element = element("div", { class: "picture-frame" }, frame, this.waiting, this.scale, this.value, this.caption);
    this.painter = new ImagePainter(
      this.picture,
      ({ time, values }) => this.painted(time, values),
      (sentence) => {
        this.waiting.hidden = false;
        setText(this.waiting, sentence);
      },
    );
    this.picture.addEventListener("pointermove", (event) => this.point(event));
    this.picture.addEventListener("pointerleave", () => setText(this.value, ""));
    frame.addEventListener("wheel", (event) => this.wheel(event, frame), { passive: false });
    let from: { x: number; y: number } | null = null;
    frame.addEventListener("pointerdown", ({ clientX, clientY }) => (from = { x: frame.scrollLeft + clientX, y: frame.scrollTop + clientY }));
    frame.addEventListener("pointermove", ({ buttons, clientX, clientY }) => {
      if (from && buttons === 1) frame.scrollTo(from.x - clientX, from.y - clientY);
    });
  }

  // Subscribes to the camera. Waits for the view, because a canvas can draw only when the browser's
  // graphics have started.
  listen(): void {
    this.end();
    this.end = () => {};
    this.painter.clear();
    this.values = null;
    this.shownTime = -Infinity;
    this.scale.hidden = true;
    setText(this.caption, "");
    setText(this.value, "");
    this.waiting.hidden = false;
    const { view, replay, inPast } = this.ports.state.get();
    // A recording contains only images that were requested during recording. If there is an image
    // for the present instant, the replay sends it at once.
    const missing = inPast ? "Camera images of past times are not stored. Press Live to see the present image." : "The recording has no image of this camera up to this time.";
    setText(this.waiting, replay ? missing : "Waiting for an image…");
    if (view === "starting") return;
    this.end = this.ports.topics.subscribe<CameraImage>(this.camera.topic, (image) => this.painter.take(image), { form: "image" });
  }

  close(): void {
    this.end();
    this.end = () => {};
  }

  // Updates the image's age after a change of simulated time.
  judgeAge(): void {
    const { replay, time } = this.ports.state.get();
    // The replay may have moved to an instant before the time of the image.
    this.picture.classList.toggle("of-later", replay !== null && this.shownTime > time + SAME_INSTANT_S);
    if (this.shownTime === -Infinity) return;
    const age = time - this.shownTime;
    const isBehind = age > BEHIND_S;
    this.caption.classList.toggle("behind", isBehind);
    setText(this.caption, isBehind ? `${formatTime(this.shownTime)} · ${age.toFixed(1)} s old` : formatTime(this.shownTime));
  }

  zoomBy(factor: number): void {
    this.zoom = factor === 0 ? 1 : Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, this.zoom * factor));
    const size = `${100 * this.zoom}%`;
    this.picture.style.width = this.picture.style.height = size;
    this.picture.style.imageRendering = this.zoom > 2 ? "pixelated" : "";
  }

  private painted(time: number, values: ValueImage | null): void {
    this.waiting.hidden = true;
    this.shownTime = time;
    this.values = values;
    this.scale.hidden = values === null;
    if (values) {
      const [least, largest] = spanOf(values.values);
      setText(this.least, formatValue(least, values.unit));
      setText(this.largest, formatValue(largest, values.unit));
    }
    this.judgeAge();
  }

  // Shows the value under the pointer. The image is in the centre of the canvas, as large as the
  // canvas allows.
  private point({ offsetX, offsetY }: PointerEvent): void {
    if (!this.values) return setText(this.value, "");
    const { width, height, values, unit } = this.values;
    const { clientWidth, clientHeight } = this.picture;
    const scale = Math.min(clientWidth / width, clientHeight / height);
    const x = Math.floor((offsetX - (clientWidth - width * scale) / 2) / scale);
    const y = Math.floor((offsetY - (clientHeight - height * scale) / 2) / scale);
    const isInside = x >= 0 && y >= 0 && x < width && y < height;
    const value = isInside ? values[y * width + x]! : NaN;
    setText(this.value, isInside ? `(${x}, ${y}): ${Number.isFinite(value) ? formatValue(value, unit) : "nothing"}` : "");
  }

  private wheel(event: WheelEvent, frame: HTMLElement): void {
    event.preventDefault();
    const before = this.zoom;
    this.zoomBy(event.deltaY < 0 ? ZOOM_STEP : 1 / ZOOM_STEP);
    // When the scale changes, the point of the image under the pointer does not move on the page.
    const { left, top } = frame.getBoundingClientRect();
    const [x, y] = [event.clientX - left, event.clientY - top];
    const growth = this.zoom / before;
    frame.scrollTo((frame.scrollLeft + x) * growth - x, (frame.scrollTop + y) * growth - y);
  }
}
