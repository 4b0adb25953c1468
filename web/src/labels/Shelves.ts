// Allocates parts of rows, like books on shelves. All rows have the same length. Numbers are in
// pixels.

export interface Slot {
  row: number;
  x: number;
  width: number;
}

interface Gap {
  x: number;
  width: number;
}

export class Shelves {
  private readonly gaps: Gap[][] = []; // the gaps of each row, from left to right

  constructor(
    private readonly length: number,
    rows: number,
  ) {
    this.addRows(rows);
  }

  get rows(): number {
    return this.gaps.length;
  }

  addRows(count: number): void {
    for (let i = 0; i < count; i++) this.gaps.push([{ x: 0, width: this.length }]);
  }

  // Returns the first slot of this width; null if no gap is wide enough.
  add(width: number): Slot | null {
    for (const [row, gaps] of this.gaps.entries()) {
      const at = gaps.findIndex((gap) => gap.width >= width);
      if (at < 0) continue;
      const gap = gaps[at]!;
      const { x } = gap;
      gap.x += width;
      gap.width -= width;
      if (gap.width === 0) gaps.splice(at, 1);
      return { row, x, width };
    }
    return null;
  }

  // Makes the slot a gap, and joins it with the gaps on both sides.
  remove({ row, x, width }: Slot): void {
    const gaps = this.gaps[row]!;
    let at = gaps.findIndex((gap) => gap.x > x);
    if (at < 0) at = gaps.length;
    const freed = { x, width };
    const before = gaps[at - 1];
    const after = gaps[at];
    gaps.splice(at, 0, freed);
    if (after && x + width === after.x) {
      freed.width += after.width;
      gaps.splice(at + 1, 1);
    }
    if (before && before.x + before.width === x) {
      before.width += freed.width;
      gaps.splice(at, 1);
    }
  }
}
