// The images of one robot's camera, as they arrive. It listens only while it is in sight.
import type { CameraChoice } from "../../api/scene";
import { camerasOf } from "../../api/scene";
import type { ColouredImage } from "../../live/greyPng";
import { colouredGreyPng } from "../../live/greyPng";
import type { CompressedImageMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { formatTime } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "topics" | "cameras">;

const SEPARATOR = " · ";
const SAME_INSTANT_S = 1e-6;

export function mount({ state, topics, cameras }: Ports): MountedPanel {
  const choice = element("select", { "aria-label": "Camera" });
  const picture = element("canvas", { class: "picture", role: "img", "aria-label": "Camera image" });
  picture.width = picture.height = 1;
  const caption = element("span", { class: "picture-time number" });
  const waiting = element("p", { class: "picture-waiting" });
  const body = element("div", { class: "picture-frame" }, picture, waiting, caption);
  const hint = element("p", { class: "hint" }, "No robot has a camera.");

  let isOpen = false;
  let unsubscribe = () => {};
  let shownTime = -Infinity; // s, of the picture
  // A recording may have been moved to before its first picture.
  const judgeAge = () => {
    const { replay, time } = state.get();
    picture.classList.toggle("of-later", replay !== null && shownTime > time + SAME_INSTANT_S);
  };
  const painter = new PicturePainter(picture, (time) => {
    waiting.hidden = true;
    setText(caption, formatTime(time));
    shownTime = time;
    judgeAge();
  });
  state.watch(({ time }) => time, judgeAge);
  const listen = (camera: CameraChoice | null) => {
    unsubscribe();
    unsubscribe = () => {};
    painter.clear();
    setText(caption, "");
    waiting.hidden = false;
    const { view, replay } = state.get();
    // A recording holds those that somebody asked for; what it has, it gives at once.
    setText(waiting, replay ? "The recording has no image of this camera up to this time." : "Waiting for an image…");
    body.hidden = choice.hidden = !camera;
    hint.hidden = camera !== null;
    if (camera) choice.value = camera.topic;
    // A canvas takes its first picture only when the browser has started what draws.
    if (camera && isOpen && view !== "starting") {
      unsubscribe = topics.subscribe<CompressedImageMessage>(camera.topic, (image) => painter.take(image));
    }
  };

  choice.addEventListener("change", () => {
    const camera = camerasOf(state.get().scene).find(({ topic }) => topic === choice.value);
    if (camera) cameras.show(camera);
  });
  state.watch(
    ({ scene }) => camerasOf(scene),
    (all) => fillChoice(choice, all, state.get().camera),
  );
  state.watch(
    ({ camera }) => camera,
    listen,
    (a, b) => a?.topic === b?.topic,
  );
  // Another simulation has another stream, even under the same topic's name.
  state.watch(
    ({ simulation, view, replay }) => ({
      simulation,
      isStarting: view === "starting",
      isRecorded: replay !== null,
    }),
    () => listen(state.get().camera),
    shallowEqual,
  );
  const follow = (open: boolean) => {
    isOpen = open;
    listen(state.get().camera);
  };
  return {
    body: element("div", { class: "camera-body" }, hint, body),
    tools: [choice],
    whileOpen: () => {
      follow(true);
      return () => follow(false);
    },
  };
}

function fillChoice(choice: HTMLSelectElement, cameras: readonly CameraChoice[], chosen: CameraChoice | null): void {
  choice.replaceChildren(
    ...cameras.map(({ robot, sensor, topic }) => new Option(robot + SEPARATOR + sensor, topic)),
  );
  if (chosen) choice.value = chosen.topic;
}

// Decodes one picture at a time; of those that arrive meanwhile only the newest is kept.
class PicturePainter {
  private next: CompressedImageMessage | null = null;
  private busy = false;
  private isPainted = false;
  private generation = 0;
  // Kept by the processor, not the graphics card: where none is, the page would wait for the 3D picture
  // that is being drawn.
  private readonly context: CanvasRenderingContext2D | null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly onPainted: (time: number) => void,
  ) {
    this.context = canvas.getContext("2d", { willReadFrequently: true });
  }

  clear(): void {
    this.generation += 1;
    this.next = null;
    // The first call on a canvas waits until the browser has started to draw.
    if (this.isPainted) this.context?.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.isPainted = false;
  }

  take(image: CompressedImageMessage): void {
    this.next = image;
    if (!this.busy) void this.paintAll();
  }

  private async paintAll(): Promise<void> {
    this.busy = true;
    while (this.next) {
      const image = this.next;
      this.next = null;
      await this.paint(image, this.generation);
    }
    this.busy = false;
  }

  private async paint(image: CompressedImageMessage, generation: number): Promise<void> {
    if (image.format.startsWith("mono16")) {
      const shown = await colouredGreyPng(image.data.slice());
      if (shown && generation === this.generation) this.paintColoured(shown, image);
      return;
    }
    const type = image.format.includes("png") ? "image/png" : "image/jpeg";
    // A copy: the message may be a view on memory that the connection uses again.
    const blob = new Blob([image.data.slice()], { type });
    const bitmap = await createImageBitmap(blob).catch(() => null);
    if (!bitmap || generation !== this.generation) return;
    this.canvas.width = bitmap.width;
    this.canvas.height = bitmap.height;
    this.context?.drawImage(bitmap, 0, 0);
    this.isPainted = true;
    bitmap.close();
    this.onPainted(seconds(image.header.stamp));
  }

  private paintColoured({ width, height, rgba }: ColouredImage, { header }: CompressedImageMessage): void {
    this.canvas.width = width;
    this.canvas.height = height;
    this.context?.putImageData(new ImageData(rgba, width, height), 0, 0);
    this.isPainted = true;
    this.onPainted(seconds(header.stamp));
  }
}
