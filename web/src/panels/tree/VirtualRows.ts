// A list that may have thousands of entries. The page has elements only for the visible entries.
// When the user scrolls, the elements are reused for other entries.
import { element, setAttribute } from "../../ui/element";

const BEYOND_PX = 200; // there are also elements this far above and below the visible part
const HEIGHT_WITHOUT_LAYOUT_PX = 800;

// A row, which can show any entry of its kind.
export interface Row<Entry> {
  readonly element: HTMLElement;
  write(entry: Entry): void;
}

export interface RowKinds<Entry> {
  keyOf(entry: Entry): string; // the key of an entry; it does not change when the entry moves
  kindOf(entry: Entry): string; // the kind of an entry; entries of one kind share rows
  heightOf(entry: Entry): number; // px
  make(kind: string): Row<Entry>;
}

interface PlacedRow<Entry> extends Row<Entry> {
  kind: string;
  top: number;
}

export class VirtualRows<Entry> {
  readonly list: HTMLElement;
  readonly scroller: HTMLElement;
  private entries: readonly Entry[] = [];
  private tops: number[] = [0]; // the top of each entry, and the end of the last one
  private rows = new Map<string, PlacedRow<Entry>>(); // by key
  private readonly spare: PlacedRow<Entry>[] = [];
  private total = 0; // px: height of all entries
  private scrollTop = 0; // the scroll position that was last read
  private height = HEIGHT_WITHOUT_LAYOUT_PX;

  constructor(
    private readonly kinds: RowKinds<Entry>,
    label: string,
  ) {
    this.list = element("ul", { class: "robots", "aria-label": label });
    this.scroller = element("div", { class: "robot-scroll" }, this.list);
    this.scroller.addEventListener("scroll", () => this.look(), { passive: true });
    if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => this.look()).observe(this.scroller);
  }

  show(entries: readonly Entry[]): void {
    this.entries = entries;
    const tops = [0];
    for (let i = 0; i < entries.length; i++) tops.push(tops[i]! + this.kinds.heightOf(entries[i]!));
    this.tops = tops;
    const height = tops.at(-1)!;
    if (height !== this.total) this.list.style.height = `${height}px`;
    this.total = height;
    this.draw();
  }

  scrollTo(index: number): void {
    this.look();
    const { height } = this;
    const [top, bottom] = [this.tops[index]!, this.tops[index + 1]!];
    const { scrollTop } = this;
    if (top < scrollTop) this.scroller.scrollTop = top;
    else if (bottom > scrollTop + height) this.scroller.scrollTop = bottom - height;
    this.look();
  }

  // Reads the scroll position and draws the rows. The position is read only here, because reading
  // it makes the browser lay out the page.
  private look(): void {
    this.scrollTop = this.scroller.scrollTop;
    this.height = this.scroller.clientHeight || HEIGHT_WITHOUT_LAYOUT_PX;
    this.draw();
  }

  private draw(): void {
    const { scrollTop } = this;
    const first = this.indexAt(scrollTop - BEYOND_PX);
    const last = Math.min(this.entries.length - 1, this.indexAt(scrollTop + this.height + BEYOND_PX));
    const inSight = this.entries.slice(first, last + 1);
    const kept = new Set(inSight.map((entry) => this.kinds.keyOf(entry)));
    for (const [key, row] of [...this.rows]) {
      if (kept.has(key)) continue;
      this.rows.delete(key);
      row.element.remove();
      this.spare.push(row);
    }
    inSight.forEach((entry, i) => this.place(entry, first + i, i));
  }

  // Shows an entry in a row. `index` is the entry's index in the list, `nth` its index among the
  // entries that have rows.
  private place(entry: Entry, index: number, nth: number): void {
    const key = this.kinds.keyOf(entry);
    const row = this.rows.get(key) ?? this.take(this.kinds.kindOf(entry));
    this.rows.set(key, row);
    const top = this.tops[index]!;
    if (row.top !== top) {
      row.top = top;
      row.element.style.transform = `translateY(${top}px)`;
    }
    // The elements must have the order of the entries, because keyboard users move from element to
    // element in this order.
    const there = this.list.children[nth];
    if (there !== row.element) this.list.insertBefore(row.element, there ?? null);
    setAttribute(row.element, "aria-setsize", String(this.entries.length));
    setAttribute(row.element, "aria-posinset", String(index + 1));
    row.write(entry);
  }

  private take(kind: string): PlacedRow<Entry> {
    const at = this.spare.findIndex((row) => row.kind === kind);
    if (at >= 0) return this.spare.splice(at, 1)[0]!;
    const row = this.kinds.make(kind);
    return { element: row.element, write: (entry) => row.write(entry), kind, top: -1 };
  }

  // Returns the index of the last entry whose top is at or above `height` (px from the list's top).
  private indexAt(height: number): number {
    let [low, high] = [0, Math.max(0, this.entries.length - 1)];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.tops[middle]! <= height) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}
