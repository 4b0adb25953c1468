// The columns of a grid of images.

const ASPECT = 4 / 3.4; // width by height of a cell: an image of 4 by 3 below its name
const GAP_PX = 6; // between cells and around the grid
const MIN_WIDTH_PX = 170; // minimum width of a cell

export interface Grid {
  columns: number;
  // in CSS pixels; null: the columns share the width of the panel, and the grid scrolls
  cellWidth: number | null;
}

// Returns the number of columns with which `count` cells are as large as possible in an area of
// this size in CSS pixels. If the cells would be narrower than MIN_WIDTH_PX, they get at least this
// width, and the grid scrolls.
export function gridFor(count: number, width: number, height: number): Grid {
  let [best, largest] = [1, 0];
  for (let columns = 1; columns <= count; columns++) {
    const cellWidth = widthOf(columns, count, width, height);
    if (cellWidth > largest) [best, largest] = [columns, cellWidth];
  }
  if (largest >= MIN_WIDTH_PX) return { columns: best, cellWidth: Math.floor(largest) };
  const columns = Math.min(count, Math.floor((width - GAP_PX) / (MIN_WIDTH_PX + GAP_PX)));
  return { columns: Math.max(1, columns), cellWidth: null };
}

// The width of a cell if all rows fit into the panel without scrolling.
function widthOf(columns: number, count: number, width: number, height: number): number {
  const rows = Math.ceil(count / columns);
  const byWidth = (width - GAP_PX) / columns - GAP_PX;
  const byHeight = ASPECT * ((height - GAP_PX) / rows - GAP_PX);
  return Math.min(byWidth, byHeight);
}
