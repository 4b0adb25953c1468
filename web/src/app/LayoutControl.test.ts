import { expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import type { Split } from "../state/layout";
import { textOf } from "../state/layout";
import { MAX_SAVED } from "../state/layouts";
import { STANDARD } from "../workspace/presets";
import { LayoutControl } from "./LayoutControl";

const SPACE = { width: 1000, height: 700 };
const STANDARD_TEXT = textOf(STANDARD.layout(SPACE));

function fixture(kept: Record<string, string> = {}, linked: string | null = null) {
  const items = new Map(Object.entries(kept));
  const storage = {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
  } as Storage;
  const store = new Store<State>(initialState);
  const host = {
    layout: "",
    space: SPACE,
    show: vi.fn((layout: Split) => {
      host.layout = textOf(layout);
    }),
  };
  const control = new LayoutControl(store, storage, new Set(["view", "inspector", "images", "log"]));
  control.start(host, linked);
  const notices = () => store.get().notices.map(({ sentence }) => sentence);
  return { control, host, store, items, notices };
}

test("the page starts with the link's layout, the last layout, or the standard layout", () => {
  expect(fixture().host.layout).toBe(STANDARD_TEXT);
  expect(fixture({ "gsv.layout": "r(view~600,log~400)" }).host.layout).toBe("r(view~600,log~400)");
  expect(fixture({ "gsv.layout": "r(view~600,log~400)" }, "r(view~900,log~100)").host.layout).toBe("r(view~900,log~100)");
  expect(fixture({}, "standard").host.layout).toBe(STANDARD_TEXT);
});

test("a broken layout shows an error and the standard layout", () => {
  const { host, notices } = fixture({}, "r(view");
  expect(host.layout).toBe(STANDARD_TEXT);
  expect(notices()).toEqual([
    "The layout in the page's address cannot be shown: expected ~ and a share at character 7, found the end. The page shows the standard layout.",
  ]);
});

test("a layout with panels of another version is shown without them", () => {
  const { host, notices } = fixture({}, "r(view~600,log.hologram~400)");
  expect(host.layout).toBe("r(view~600,log~400)");
  expect(notices()[0]).toContain("It has panels that this page does not know and leaves out: hologram.");
});

test("a link contains a preset's name or a layout's text, and nothing for the standard layout", () => {
  const { control } = fixture();
  expect(control.linkText).toBeNull();
  control.showText("r(view~600,log~400)", "It");
  expect(control.linkText).toBe("r(view~600,log~400)");
});

test("layouts are saved, shown, replaced and deleted by name", () => {
  const { control, host, store, items } = fixture({}, "r(view~600,log~400)");
  control.save("  Mine ");
  control.showText("standard", "It");
  const mine = store.get().layouts[0]!;
  control.showSaved(mine);
  expect(host.layout).toBe("r(view~600,log~400)");
  control.save("Mine");
  expect(store.get().layouts).toHaveLength(1);
  expect(JSON.parse(items.get("gsv.layouts")!)).toEqual([{ name: "Mine", text: "r(view~600,log~400)" }]);
  control.remove("Mine");
  expect(store.get().layouts).toEqual([]);
});

test("a layout needs a name", () => {
  const { control, store, notices } = fixture();
  control.save("  ");
  expect(store.get().layouts).toEqual([]);
  expect(notices()).toEqual(["Type a name for the layout first."]);
});

test("a layout from a file is saved under its name", async () => {
  const { control, host, store } = fixture();
  const content = JSON.stringify({ gsv_layout: 1, name: "Lab", layout: "r(view~800,log~200)" });
  await control.importFile(new File([content], "lab.json"));
  expect(host.layout).toBe("r(view~800,log~200)");
  expect(store.get().layouts).toEqual([{ name: "Lab", text: "r(view~800,log~200)" }]);
});

test("with the maximum number of layouts, an imported layout is shown, and an error says that it is not saved", async () => {
  const saved = Array.from({ length: MAX_SAVED }, (_, i) => ({ name: `Layout ${i}`, text: "r(view~600,log~400)" }));
  const { control, host, store, items, notices } = fixture({ "gsv.layouts": JSON.stringify(saved) });
  const fileNamed = (name: string) =>
    new File([JSON.stringify({ gsv_layout: 1, name, layout: "r(view~800,log~200)" })], "lab.json");
  await control.importFile(fileNamed("Lab"));
  expect(host.layout).toBe("r(view~800,log~200)");
  expect(notices()).toEqual(["40 layouts are saved already. Delete one first."]);
  expect(store.get().layouts).toEqual(saved);
  expect(JSON.parse(items.get("gsv.layouts")!)).toEqual(saved);
  await control.importFile(fileNamed("Layout 7")); // replaces the layout with this name
  expect(notices()).toHaveLength(1);
  expect(store.get().layouts.at(-1)).toEqual({ name: "Layout 7", text: "r(view~800,log~200)" });
});

test("a file that is not a layout is rejected with its name, and nothing changes", async () => {
  const { control, host, notices } = fixture();
  await control.importFile(new File(["{}"], "x.json"));
  await control.importFile(new File(["x".repeat(64_001)], "big.json"));
  expect(host.layout).toBe(STANDARD_TEXT);
  expect(notices()).toEqual([
    'x.json is no layout: it has no "gsv_layout".',
    "big.json is no layout: it has 64001 bytes; the limit is 64000.",
  ]);
});
