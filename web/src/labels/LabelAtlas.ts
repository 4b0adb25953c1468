// Keeps images of labels on one canvas, so that the text of each label is drawn only once. The
// canvas grows up to a limit. After that, the labels that were not used for the longest time are
// removed.
import type { LabelKind } from "./LabelPainter";
import { LabelPainter, heightOf } from "./LabelPainter";
import type { Slot } from "./Shelves";
import { Shelves } from "./Shelves";

// Sizes in device pixels.
const WIDTH = 2048;
const FIRST_HEIGHT = 128;
const MAX_HEIGHT = 2048; // with one device pixel for a CSS pixel, and at most twice as much otherwise
const GAP = 1; // transparent pixels between labels
const MAX_WIDTHS = 20_000; // maximum number of stored widths

// With more pixels, the longest label would not fit on the canvas.
export const MAX_RATIO = 4;

// The place of a label on the canvas, in device pixels.
export interface LabelImage {
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Entry extends LabelImage {
  slot: Slot;
  used: number; // the frame in which it was last used
}

export class LabelAtlas {
  private present = document.createElement("canvas");
  private context = this.present.getContext("2d");
  private readonly entries = new Map<string, Entry>();
  private readonly widths = new Map<string, number>();
  private readonly shelves: Shelves;
  private readonly maxRows: number;
  private readonly rowHeight: number;
  private frame = 0;

  constructor(
    private readonly painter: LabelPainter,
    readonly ratio: number, // device pixels for a CSS pixel, at most MAX_RATIO
  ) {
    this.rowHeight = heightOf(ratio) + GAP;
    this.maxRows = Math.max(1, Math.floor((MAX_HEIGHT * Math.min(2, Math.max(1, ratio))) / this.rowHeight));
    this.shelves = new Shelves(WIDTH, Math.max(1, Math.min(this.maxRows, Math.floor(FIRST_HEIGHT / this.rowHeight))));
    this.present.width = WIDTH;
    this.present.height = this.shelves.rows * this.rowHeight;
  }

  // The canvas with the images. It may be replaced when an image is added.
  get canvas(): HTMLCanvasElement {
    return this.present;
  }

  // The number of images.
  get size(): number {
    return this.entries.size;
  }

  // Call this before the labels of a frame are looked up. The images of a frame stay valid until the
  // next frame begins.
  beginFrame(): void {
    this.frame += 1;
  }

  // Returns the width of a label, in device pixels.
  widthOf(name: string): number {
    let width = this.widths.get(name);
    if (width !== undefined) return width;
    if (this.widths.size >= MAX_WIDTHS) this.widths.clear();
    width = this.painter.widthOf(name, this.ratio);
    this.widths.set(name, width);
    return width;
  }

  // Returns the image of a label, and draws it if it is missing. Returns null if the canvas is full
  // of labels of the present frame.
  imageOf(name: string, kind: LabelKind): LabelImage | null {
    const key = `${kind}\n${name}`;
    let entry = this.entries.get(key);
    if (!entry) {
      const width = this.widthOf(name);
      const slot = this.allocate(width + GAP);
      if (!slot) return null;
      entry = { slot, x: slot.x, y: slot.row * this.rowHeight, width, height: this.rowHeight - GAP, used: 0 };
      this.draw(name, kind, entry);
      this.entries.set(key, entry);
    }
    entry.used = this.frame;
    return entry;
  }

  private draw(name: string, kind: LabelKind, { x, y, width }: LabelImage): void {
    if (!this.context) return;
    // Removed labels are still there.
    this.context.clearRect(x, y, width + GAP, this.rowHeight);
    this.painter.paint(this.context, name, kind, x, y, width, this.ratio);
  }

  private allocate(width: number): Slot | null {
    for (;;) {
      const slot = this.shelves.add(width);
      if (slot || !(this.grow() || this.evict())) return slot;
    }
  }

  // Doubles the number of rows. Returns false if the canvas has its maximum size.
  private grow(): boolean {
    const { rows } = this.shelves;
    const more = Math.min(rows, this.maxRows - rows);
    if (more === 0) return false;
    this.shelves.addRows(more);
    const smaller = this.present;
    this.present = document.createElement("canvas");
    this.present.width = WIDTH;
    this.present.height = (rows + more) * this.rowHeight;
    this.context = this.present.getContext("2d");
    this.context?.drawImage(smaller, 0, 0);
    return true;
  }

  // Removes the least recently used half of the labels that the present frame does not use. Returns
  // false if there are none.
  private evict(): boolean {
    const unused = [...this.entries].filter(([, { used }]) => used < this.frame);
    unused.sort(([, a], [, b]) => a.used - b.used);
    for (const [key, { slot }] of unused.slice(0, Math.ceil(unused.length / 2))) {
      this.shelves.remove(slot);
      this.entries.delete(key);
    }
    return unused.length > 0;
  }
}
