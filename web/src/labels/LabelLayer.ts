// Names above the robots, on a canvas over the view. They are copied from the atlas to whole pixels
// of the screen, so they are sharp even if the image below them has fewer pixels. The canvas does
// not receive the pointer: the canvas of the view asks `at` for the name at a place. For screen
// readers, the first names are also a text, which is not visible.
import type { LabelledRobots, LabelView } from "./LabelChoice";
import { LabelChoice } from "./LabelChoice";
import type { LabelImage } from "./LabelAtlas";
import { LabelAtlas, MAX_RATIO } from "./LabelAtlas";
import type { LabelKind } from "./LabelPainter";
import { LABEL_HEIGHT, LabelPainter } from "./LabelPainter";
import { SpokenNames } from "./SpokenNames";

// A label of the present frame. Its box is in CSS pixels of the view.
export interface ShownLabel {
  name: string;
  kind: LabelKind;
  x: number;
  y: number;
  width: number;
  height: number;
}

interface DrawnLabel {
  image: LabelImage;
  left: number; // device pixels of the view
  top: number;
}

export class LabelLayer {
  readonly element = document.createElement("div");
  isPickable = true; // whether the pointer finds labels
  private readonly canvas = document.createElement("canvas");
  private context: CanvasRenderingContext2D | null = null;
  private readonly painter = new LabelPainter(this.element);
  private readonly spoken = new SpokenNames();
  private atlas = new LabelAtlas(this.painter, 1);
  private readonly choice = new LabelChoice((name) => this.atlas.widthOf(name) / this.atlas.ratio);
  private labels: readonly ShownLabel[] = []; // the most important one first
  private drawn: readonly DrawnLabel[] = [];

  // `onRestored` is called when the browser has deleted the canvases and they must be drawn again.
  constructor(onRestored: () => void = () => {}) {
    this.element.className = "labels";
    this.canvas.setAttribute("aria-hidden", "true");
    this.element.append(this.canvas, this.spoken.element);
    this.canvas.addEventListener("contextrestored", () => {
      this.renewLook();
      onRestored();
    });
  }

  // The labels of the last frame, the most important one first.
  get shown(): readonly ShownLabel[] {
    return this.element.hidden ? [] : this.labels;
  }

  // Shows the labels of a frame.
  place(view: LabelView, robots: LabelledRobots): void {
    this.fit(view);
    const { names, selection } = robots;
    const { atlas, choice } = this;
    const { ratio } = atlas;
    const labels: ShownLabel[] = [];
    const drawn: DrawnLabel[] = [];
    atlas.beginFrame();
    for (const robot of choice.choose(view, robots)) {
      const name = names[robot]!;
      const kind = kindOf(name === selection, robots.badness(robot) > 0);
      const image = atlas.imageOf(name, kind);
      if (!image) continue;
      const left = Math.round(choice.across[robot]! * ratio - image.width / 2);
      const top = Math.round(choice.down[robot]! * ratio) - image.height;
      labels.push({ name, kind, x: left / ratio, y: top / ratio, width: image.width / ratio, height: LABEL_HEIGHT });
      drawn.push({ image, left, top });
    }
    this.labels = labels;
    this.draw(drawn);
    this.spoken.set(labels);
  }

  // Removes all labels.
  clear(): void {
    this.labels = [];
    this.draw([]);
    this.spoken.set([]);
  }

  // Returns the name of the label at a place of the view, in CSS pixels; null if there is none.
  at(x: number, y: number): string | null {
    if (!this.isPickable) return null;
    const isAt = (box: ShownLabel) => x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
    return this.shown.find(isAt)?.name ?? null;
  }

  // Draws the labels at their present places on an image of the view. `width` is the width of the
  // view in CSS pixels.
  paint(context: CanvasRenderingContext2D, width: number): void {
    const ratio = context.canvas.width / width;
    for (const { name, kind, x, y, width: across } of this.shown.toReversed()) {
      const wanted = this.painter.widthOf(name, ratio);
      const left = Math.round((x + across / 2) * ratio - wanted / 2);
      this.painter.paint(context, name, kind, left, Math.round(y * ratio), wanted, ratio);
    }
  }

  // Call this when the results of `badness` or `isShown` may have changed.
  renew(): void {
    this.choice.renew();
  }

  // Call this when the style of the page has changed.
  renewLook(): void {
    this.painter.renew();
    this.atlas = new LabelAtlas(this.painter, this.atlas.ratio);
    this.choice.renew();
    this.drawn = [];
  }

  // Fits the canvas to the view and to the pixels of the screen.
  private fit({ width, height }: LabelView): void {
    const ratio = Math.min(MAX_RATIO, devicePixelRatio);
    if (ratio !== this.atlas.ratio) {
      this.atlas = new LabelAtlas(this.painter, ratio);
      this.choice.renew();
    }
    const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width === across && this.canvas.height === down) return;
    this.canvas.width = across;
    this.canvas.height = down;
    // A pixel of the canvas is exactly a pixel of the screen.
    this.canvas.style.width = `${across / ratio}px`;
    this.canvas.style.height = `${down / ratio}px`;
    this.drawn = [];
  }

  private draw(drawn: readonly DrawnLabel[]): void {
    // To draw the same image again would make the browser compose the page again.
    if (isSame(drawn, this.drawn)) return;
    this.drawn = drawn;
    this.context ??= this.canvas.getContext("2d");
    const { context, atlas } = this;
    if (!context) return;
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    // While robots move, labels may overlap for a short time. The most important one is on top.
    for (let i = drawn.length - 1; i >= 0; i--) {
      const { image, left, top } = drawn[i]!;
      const { x, y, width, height } = image;
      context.drawImage(atlas.canvas, x, y, width, height, left, top, width, height);
    }
  }
}

function kindOf(isSelected: boolean, hasTrouble: boolean): LabelKind {
  if (isSelected) return hasTrouble ? "label selected trouble" : "label selected";
  return hasTrouble ? "label trouble" : "label";
}

function isSame(a: readonly DrawnLabel[], b: readonly DrawnLabel[]): boolean {
  return a.length === b.length && a.every(({ image, left, top }, i) => image === b[i]!.image && left === b[i]!.left && top === b[i]!.top);
}
