// The preset layouts. A side panel has a fixed width in pixels, so it does not grow with the
// window. The view gets the remaining space.
import type { Part, Split } from "../state/layout";
import { VIEW } from "../state/layout";

export interface Space {
  width: number; // size of the area for the layout, CSS pixels
  height: number;
}

export interface Preset {
  name: string; // name in links and menus
  title: string;
  hint: string;
  layout(space: Space): Split;
}

const SIDE_PX = 280;
const WIDE_SIDE_PX = 380;
const BELOW_PX = 240;

export const PRESETS: readonly Preset[] = [
  {
    name: "standard",
    title: "Standard",
    hint: "View, inspector and camera",
    layout: ({ width }) => beside(width, SIDE_PX, tabs(VIEW), column([tabs("inspector"), 570], [tabs("images"), 430])),
  },
  {
    name: "drive",
    title: "Drive",
    hint: "Large camera image and the driving pad beside the view",
    layout: ({ width }) => beside(width, WIDE_SIDE_PX, tabs(VIEW), column([tabs("images"), 500], [tabs("teleoperation", "inspector"), 500])),
  },
  {
    name: "debug",
    title: "Debug a behaviour",
    hint: "Inspector, plots, and the log",
    layout: ({ width, height }) =>
      beside(width, SIDE_PX, below(height, tabs(VIEW), row([tabs("plots"), 500], [tabs("log"), 500])), column([tabs("inspector"), 650], [tabs("images"), 350])),
  },
  {
    name: "crowd",
    title: "Watch a crowd",
    hint: "Large view with diagnostics, status and log below it",
    layout: ({ height }) => below(height, tabs(VIEW), tabs("diagnostics", "status", "log")),
  },
  {
    name: "replay",
    title: "Replay a failure",
    hint: "Plots and log below the view, inspector and camera beside it",
    layout: ({ width, height }) =>
      beside(width, SIDE_PX, below(height, tabs(VIEW), row([tabs("log"), 500], [tabs("plots"), 500])), column([tabs("inspector", "status"), 600], [tabs("images"), 400])),
  },
];

export const STANDARD = PRESETS[0]!;

function tabs(...ids: string[]): Part {
  return { tabs: ids, front: ids[0]! };
}

function row(...parts: [Part, number][]): Split {
  return { split: "row", parts: parts.map(([part, share]) => ({ part, share })) };
}

function column(...parts: [Part, number][]): Split {
  return { split: "column", parts: parts.map(([part, share]) => ({ part, share })) };
}

// Returns a row of both parts. `side` has a width of `sidePx`, but at most half of `width`.
function beside(width: number, sidePx: number, main: Part, side: Part): Split {
  const share = Math.round(1000 * Math.min(0.5, sidePx / Math.max(1, width)));
  return row([main, 1000 - share], [side, share]);
}

function below(height: number, main: Part, lower: Part): Split {
  const share = Math.round(1000 * Math.min(0.5, BELOW_PX / Math.max(1, height)));
  return column([main, 1000 - share], [lower, share]);
}
