// Converts layouts of this page to and from dockview's form, in CSS pixels.
import type { SerializedDockview } from "dockview";
import { Orientation } from "dockview";
import type { Part, Split } from "../state/layout";
import type { Space } from "./presets";

type GridNode = SerializedDockview["grid"]["root"];

export interface NamedPanel {
  id: string;
  title: string;
}

export function toDockview(layout: Split, space: Space, panels: readonly NamedPanel[]): SerializedDockview {
  const isRow = layout.split === "row";
  const counter = { groups: 0 };
  const root = nodeOf(layout, isRow ? space.height : space.width, space, counter);
  return {
    grid: {
      root,
      width: space.width,
      height: space.height,
      orientation: isRow ? Orientation.HORIZONTAL : Orientation.VERTICAL,
    },
    panels: Object.fromEntries(
      panels.map(({ id, title }) => [id, { id, title, contentComponent: id, tabComponent: "tab" }]),
    ),
  };
}

// `size` is the length of the part in the direction in which its parent is split. `space` is the
// area of the part. Both are in CSS pixels.
function nodeOf(part: Part, size: number, space: Space, counter: { groups: number }): GridNode {
  if ("tabs" in part) {
    counter.groups += 1;
    return { type: "leaf", size, data: { views: [...part.tabs], activeView: part.front, id: String(counter.groups) } };
  }
  const isRow = part.split === "row";
  const length = isRow ? space.width : space.height;
  const total = part.parts.reduce((sum, { share }) => sum + share, 0);
  const data = part.parts.map(({ part: inner, share }) => {
    const own = (length * share) / total;
    return nodeOf(inner, own, isRow ? { ...space, width: own } : { ...space, height: own }, counter);
  });
  return { type: "branch", size, data };
}

// The layout of a dock. Floating panels and panels in separate windows are not in the grid, and are
// omitted.
export function fromDockview({ grid }: SerializedDockview): Split | null {
  const root = partOf(grid.root, grid.orientation === Orientation.HORIZONTAL);
  if (!root) return null;
  return "split" in root ? root : { split: "row", parts: [{ part: root, share: 1000 }] };
}

function partOf(node: GridNode, isRow: boolean): Part | null {
  if (node.type === "leaf") {
    const { views, activeView } = node.data as { views: string[]; activeView?: string };
    const isEmpty = views.length === 0 || node.visible === false;
    return isEmpty ? null : { tabs: [...views], front: activeView ?? views[0]! };
  }
  const children = node.data as GridNode[];
  const total = children.reduce((sum, { size }) => sum + (size ?? 0), 0) || 1;
  const split = isRow ? "row" : "column";
  const parts = children.flatMap((child): Split["parts"] => {
    const part = partOf(child, !isRow);
    const share = Math.max(1, Math.round((1000 * (child.size ?? 0)) / total));
    // Dockview also stores rows and columns that contain only one part. These are removed.
    if (part && "split" in part && part.split === split) {
      return part.parts.map((inner) => ({ ...inner, share: Math.max(1, Math.round((inner.share * share) / 1000)) }));
    }
    return part ? [{ part, share }] : [];
  });
  if (parts.length === 0) return null;
  return parts.length === 1 ? parts[0]!.part : { split, parts };
}
