import { expect, test } from "vitest";
import type { Split } from "../state/layout";
import { MAX_LAYOUT_CHARACTERS, narrowLayout, panelsOf, readLayout, textOf } from "../state/layout";
import { fromDockview, toDockview } from "./dockviewLayout";
import { PRESETS } from "./presets";

const KNOWN = new Set(["view", "teleoperation", "inspector", "images", "log", "plots", "diagnostics", "status"]);
const SPACE = { width: 1000, height: 600 };

function layoutOf(text: string): Split {
  const read = readLayout(text, KNOWN);
  if ("problem" in read) throw new Error(read.problem);
  return read.layout;
}

test("a layout is unchanged after writing and reading its text", () => {
  const text = "r(view~740,c(inspector.log*~600,images~400)~260)";
  const layout = layoutOf(text);
  expect(layout).toEqual({
    split: "row",
    parts: [
      { part: { tabs: ["view"], front: "view" }, share: 740 },
      {
        part: {
          split: "column",
          parts: [
            { part: { tabs: ["inspector", "log"], front: "log" }, share: 600 },
            { part: { tabs: ["images"], front: "images" }, share: 400 },
          ],
        },
        share: 260,
      },
    ],
  });
  expect(textOf(layout)).toBe(text);
});

test.each([
  ["", "expected a panel at character 1, found the end"],
  ["r(view~740", "expected ) or , at character 11, found the end"],
  ["r(view)", 'expected ~ and a share at character 7, found ")"'],
  ["r(view~0)", "expected a share from 1 to 9999"],
  ["r(view~5)x", 'expected the end at character 10, found "x"'],
  ["r(view~5,view~5)", "the panel view occurs twice"],
  ["r(view~5,r(log~1)~5)", "a row is nested directly in a row"],
  [`${"r(c(".repeat(20)}view`, "its rows and columns are nested more than 12 levels deep"],
  ["x".repeat(MAX_LAYOUT_CHARACTERS + 1), "the limit is 4000"],
  [Array.from({ length: 101 }, (_, i) => `p${i}`).join("."), "more than 100 panels"],
  ["__proto__", "expected a panel at character 1"],
])("the text %j is refused: %s", (text, problem) => {
  const read = readLayout(text, KNOWN);
  expect("problem" in read && read.problem).toContain(problem);
});

test("unknown panels are omitted and listed, with their empty parts", () => {
  const read = readLayout("r(c(view~700,later~300)~600,c(older~500,log.newer*~500)~400)", KNOWN);
  expect(read).toEqual({ layout: layoutOf("r(view~600,log~400)"), unknown: ["later", "older", "newer"] });
});

test("the view is in every layout", () => {
  expect(textOf(layoutOf("log.plots"))).toBe("r(view~500,log.plots~500)");
  expect(textOf(layoutOf("r(log~300,plots~700)"))).toBe("r(view~500,log~300,plots~700)");
  expect(textOf(layoutOf("nothing.known"))).toBe("r(view~500)");
});

test("on a narrow screen all panels are tabs below the view", () => {
  expect(textOf(narrowLayout(["inspector", "log"], "log"))).toBe("c(view~560,inspector.log*~440)");
  expect(textOf(narrowLayout([], null))).toBe("c(view~560)");
});

test.each(PRESETS)("the layout $title fits every window and comes back from dockview", ({ layout }) => {
  for (const space of [SPACE, { width: 300, height: 200 }, { width: 3000, height: 2000 }]) {
    const built = layout(space);
    expect(panelsOf(built)).toContain("view");
    expect(textOf(layoutOf(textOf(built)))).toBe(textOf(built));
    const panels = panelsOf(built).map((id) => ({ id, title: id }));
    expect(fromDockview(toDockview(built, space, panels))).toEqual(built);
  }
});

test("divisions of dockview with a single part are omitted", () => {
  const leaf = (id: string, size: number) => ({ type: "leaf" as const, size, data: { views: [id], activeView: id, id } });
  const branch = (size: number, ...data: object[]) => ({ type: "branch" as const, size, data });
  const dock = (root: object) => ({ ...toDockview(layoutOf("view"), SPACE, []), grid: { root, width: 1000, height: 600, orientation: "HORIZONTAL" } });
  const text = (root: object) => textOf(fromDockview(dock(root) as never)!);
  expect(text(branch(600, branch(1000, leaf("view", 400), leaf("log", 200))))).toBe("c(view~667,log~333)");
  expect(text(branch(600, leaf("view", 500), branch(500, branch(600, leaf("log", 250), leaf("plots", 250)))))).toBe("r(view~500,log~250,plots~250)");
});

test("sizes in pixels become fractions of the available space", () => {
  const { grid } = toDockview(layoutOf("r(view~750,c(log~100,plots~300)~250)"), SPACE, []);
  const column = (grid.root.data as { size: number; data: { size: number }[] }[])[1]!;
  expect(column.size).toBe(250);
  expect(column.data.map(({ size }) => size)).toEqual([150, 450]);
});

test("the panels beside an unknown panel share its place", () => {
  const read = readLayout("r(view~740,c(r(plots~500,log~500)~600,later~400)~260)", KNOWN);
  expect(read).toEqual({ layout: layoutOf("r(view~740,plots~130,log~130)"), unknown: ["later"] });
});
