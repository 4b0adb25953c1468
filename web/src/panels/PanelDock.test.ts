// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { element } from "../ui/element";
import type { Panel } from "./contract/Panel";
import { createPanelDock } from "./PanelDock";
import { testPorts } from "./contract/testPorts";

function dockOf(panel: Partial<Panel> = {}, state: Partial<State> = {}) {
  const { ports, store } = testPorts(state);
  const isOpen = { value: false };
  const mount = vi.fn(() => ({
    body: element("p", {}, "body"),
    tools: [element("input", {})],
    whileOpen: () => {
      isOpen.value = true;
      return () => void (isOpen.value = false);
    },
  }));
  const load = vi.fn(async () => ({ mount }));
  const full = { id: "news", title: "News", hint: "", picture: "log", isAvailable: () => true, load, ...panel } as Panel;
  const close = (id: string) => store.set(({ openPanels }) => ({ openPanels: openPanels.filter((each) => each !== id) }));
  const dock = createPanelDock([full], ports, close);
  const open = (...openPanels: string[]) => store.set({ openPanels });
  return { dock, frame: dock.querySelector<HTMLElement>(".news")!, ports, store, mount, load, open, isOpen };
}

test("a panel is fetched when it is opened for the first time, and kept", async () => {
  const { frame, load, mount, open, isOpen } = dockOf();
  expect(frame.hidden).toBe(true);
  expect(load).not.toHaveBeenCalled();
  open("news");
  await vi.waitFor(() => expect(frame.hidden).toBe(false));
  expect(isOpen.value).toBe(true);
  expect(frame.textContent).toBe("Newsbody");
  frame.querySelector<HTMLButtonElement>('[aria-label="Close news"]')!.click();
  expect(frame.hidden).toBe(true);
  expect(isOpen.value).toBe(false);
  open("other", "news");
  expect(isOpen.value).toBe(true);
  expect(mount).toHaveBeenCalledOnce();
});

test("one that is closed while it is fetched is not shown", async () => {
  let arrive = () => {};
  const mount = vi.fn(() => ({ body: element("p") }));
  const load = () => new Promise<{ mount: typeof mount }>((resolve) => (arrive = () => resolve({ mount })));
  const { frame, open } = dockOf({ load });
  open("news");
  open();
  open("news");
  open();
  arrive();
  await vi.waitFor(() => expect(mount).toHaveBeenCalledOnce());
  expect(frame.hidden).toBe(true);
  open("news");
  expect(frame.hidden).toBe(false);
});

test("one that cannot be fetched is told of, closed, and tried again", async () => {
  const load = vi.fn(() => Promise.reject(new Error("no such file")));
  const { store, ports, open } = dockOf({ load });
  open("news");
  await vi.waitFor(() => expect(store.get().openPanels).toEqual([]));
  expect(ports.notices.notify).toHaveBeenCalledWith("error", "The panel News cannot be opened: no such file. Reload the page and try again.");
  open("news");
  expect(load).toHaveBeenCalledTimes(2);
});

test("one for which the server has nothing is hidden until it has", async () => {
  const { frame, store, load } = dockOf(
    { isAvailable: ({ replay }) => replay !== null },
    { openPanels: ["news"] },
  );
  expect(load).not.toHaveBeenCalled();
  store.set({ replay: { start: 0, end: 1, speed: 1, loop: false } });
  await vi.waitFor(() => expect(frame.hidden).toBe(false));
  store.set({ replay: null });
  expect(frame.hidden).toBe(true);
});
