// @vitest-environment jsdom
import { beforeAll, expect, test, vi } from "vitest";
import type { Panel } from "../panels/contract/Panel";
import { testPorts } from "../panels/contract/testPorts";
import type { State } from "../state/State";
import { element } from "../ui/element";
import { readLayout } from "../state/layout";
import { Workspace } from "./Workspace";

beforeAll(() => {
  // jsdom has no layout.
  globalThis.ResizeObserver ??= class {
    observe() {}
    unobserve() {}
    disconnect() {}
  } as typeof ResizeObserver;
  Element.prototype.scrollIntoView ??= () => {};
});

function panelOf(id: string, more: Partial<Panel> = {}) {
  const seen = { value: false };
  const mount = vi.fn(() => ({
    body: element("p", {}, `body of ${id}`),
    whileOpen: () => {
      seen.value = true;
      return () => void (seen.value = false);
    },
  }));
  const load = vi.fn(async () => ({ mount }));
  const panel: Panel = { id, title: id, hint: "", picture: "log", group: "Look", isAvailable: () => true, load, ...more };
  return { panel, mount, load, seen };
}

function workspaceOf(panels: Panel[], layout = "r(view~1000)", state: Partial<State> = {}) {
  const { ports, store } = testPorts(state);
  const view = element("section", { class: "view" });
  const workspace = new Workspace(
    { body: view, tools: [] },
    { panels, ports, setOpen: (openPanels) => store.set({ openPanels }) },
    () => layoutOf("r(view~1000)"),
  );
  document.body.replaceChildren(workspace.element);
  workspace.show(layoutOf(layout));
  const open = (...openPanels: string[]) => store.set({ openPanels });
  const button = (name: string) => workspace.element.querySelector<HTMLButtonElement>(`[aria-label="${name}"]`);
  return { workspace, ports, store, open, button, view };
}

// Returns the layout's text without the sizes.
function shapeOf(text: string): string {
  return text.replace(/~\d+/g, "");
}

function layoutOf(text: string) {
  const read = readLayout(text, new Set(["view", "news", "log", "side"]));
  if ("problem" in read) throw new Error(read.problem);
  return read.layout;
}

test("a panel is fetched when it is first opened, and kept", async () => {
  const { panel, mount, load, seen } = panelOf("news");
  const { workspace, store, open, button } = workspaceOf([panel]);
  expect(load).not.toHaveBeenCalled();
  open("news");
  await vi.waitFor(() => expect(seen.value).toBe(true));
  expect(workspace.element.textContent).toContain("body of news");
  button("Close news")!.click();
  expect(store.get().openPanels).toEqual([]);
  expect(seen.value).toBe(false);
  expect(workspace.element.textContent).not.toContain("body of news");
  open("news");
  await vi.waitFor(() => expect(seen.value).toBe(true));
  expect(mount).toHaveBeenCalledOnce();
});

test("a panel behind another tab reads nothing, and comes to the front on request", async () => {
  const [news, log] = [panelOf("news"), panelOf("log")];
  const { workspace, open } = workspaceOf([news.panel, log.panel]);
  open("news");
  await vi.waitFor(() => expect(news.seen.value).toBe(true));
  open("news", "log");
  await vi.waitFor(() => expect(log.seen.value).toBe(true));
  expect(news.seen.value).toBe(false);
  expect(workspace.isInSight("news")).toBe(false);
  workspace.reveal("news");
  expect([news.seen.value, log.seen.value]).toEqual([true, false]);
});

test("panels open below the view, or beside it if they require it", () => {
  const panels = [panelOf("news").panel, panelOf("side", { place: "side" }).panel];
  const { workspace, open } = workspaceOf(panels);
  open("news", "side");
  expect(shapeOf(workspace.layout)).toBe("c(r(view,side),news)");
});

test("a layout opens its panels, and the workspace returns it", () => {
  const { workspace, store, view } = workspaceOf([panelOf("news").panel, panelOf("log").panel], "r(view~700,c(news~500,log~500)~300)");
  expect(store.get().openPanels).toEqual(["news", "log"]);
  expect(shapeOf(workspace.layout)).toBe("r(view,c(news,log))");
  workspace.show(layoutOf("c(view~600,log~400)"));
  expect(store.get().openPanels).toEqual(["log"]);
  expect(workspace.element.contains(view)).toBe(true);
});

test("layout watchers are notified of changes by the user", async () => {
  const { workspace, open } = workspaceOf([panelOf("news").panel]);
  const changed = vi.fn();
  workspace.onChange = changed;
  open("news");
  await vi.waitFor(() => expect(changed).toHaveBeenCalled());
  expect(shapeOf(changed.mock.lastCall![0])).toBe("c(view,news)");
});

test("a panel that cannot be fetched is reported, closed, and can be opened again", async () => {
  const load = vi.fn(() => Promise.reject(new Error("no such file")));
  const { store, ports, open } = workspaceOf([panelOf("news", { load, title: "News" }).panel]);
  open("news");
  await vi.waitFor(() => expect(store.get().openPanels).toEqual([]));
  expect(ports.notices.notify).toHaveBeenCalledWith("error", "The panel News cannot be opened: no such file. Reload the page and try again.");
  open("news");
  await vi.waitFor(() => expect(load).toHaveBeenCalledTimes(2));
});

test("a panel without data shows the reason until there is data", async () => {
  const { panel, seen, load } = panelOf("news", { isAvailable: ({ replay }) => replay !== null, absence: "Open a recording." });
  const { workspace, store } = workspaceOf([panel], "r(view~700,news~300)");
  expect(workspace.element.querySelector(".panel-absent")!.textContent).toBe("Open a recording.");
  expect(load).not.toHaveBeenCalled();
  store.set({ replay: { start: 0, end: 1, speed: 1, loop: false } });
  await vi.waitFor(() => expect(seen.value).toBe(true));
  expect(workspace.element.querySelector<HTMLElement>(".panel-absent")!.hidden).toBe(true);
  store.set({ replay: null });
  expect(seen.value).toBe(false);
});

test("a panel moves to another side of the view without a mouse", async () => {
  const { workspace, button } = workspaceOf([panelOf("news").panel], "c(view~700,news~300)");
  button("Arrange news")!.click();
  const menu = button("Arrange news")!.parentElement!;
  [...menu.querySelectorAll("button")].find(({ textContent }) => textContent === "Move to the left of the view")!.click();
  await vi.waitFor(() => expect(shapeOf(workspace.layout)).toBe("r(news,view)"));
});

test("a part that would be too low joins the part above it, and returns when the panel at the top is closed", async () => {
  const panels = [panelOf("news", { place: "side" }).panel, panelOf("log", { place: "side" }).panel, panelOf("side", { place: "top-side" }).panel];
  const { workspace, open } = workspaceOf(panels, "r(view~700,c(news~600,log~400)~300)");
  open("news", "log", "side");
  expect(shapeOf(workspace.layout)).toBe("r(view,c(side,news.log))");
  expect([workspace.isInSight("news"), workspace.isInSight("log")]).toEqual([true, false]);
  open("news", "log");
  await vi.waitFor(() => expect(workspace.layout).toBe("r(view~700,c(news~600,log~400)~300)"));
});
