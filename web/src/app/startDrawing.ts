// Starts drawing the view, in the browser or on the server, according to ViewChoice.
import type { SimulationApi } from "../api/SimulationApi";
import type { LiveViewSource } from "../protocol/LiveViews";
import type { World3D } from "../scene/World3D";
import type { Drawer, State } from "../state/State";
import type { Store } from "../state/Store";
import { DrawnView } from "../view/DrawnView";
import { notify } from "./notices";
import { ViewChoice } from "./ViewChoice";

const KEY = "gsv.drawer";
const NOT_PUSHED = "This server does not push images, so the page requests each one. The view is slower.";

export function keepDrawer(storage: Storage | null, drawer: Drawer): void {
  storage?.setItem(KEY, drawer);
}

// Returns the user's choice: view=server or view=browser in the address, or else the stored choice.
export function chosenDrawer(storage: Storage | null, parameters: URLSearchParams): string | null {
  return parameters.get("view") ?? storage?.getItem(KEY) ?? null;
}

export function startDrawing(
  store: Store<State>,
  api: SimulationApi,
  live: LiveViewSource,
  world: World3D,
  options: { inSoftware: boolean; chosen: string | null },
): ViewChoice {
  let choice: ViewChoice;
  const fetchImage = async (query: string, signal: AbortSignal) => {
    await untilVisible();
    await until(store, ({ simulation, connection }) => simulation !== null && connection.phase === "open");
    return api.image(store.get().simulation!, query, signal);
  };
  const fail = (sentence: string) => {
    notify(store, "error", sentence);
    if (!choice.serverFailed()) store.set({ view: "none", whyNoView: sentence });
  };
  const use = (drawer: Drawer) => {
    store.set({ whyNoView: "" });
    // A simulation that is still being set up does not exist on the server, so the browser draws
    // it.
    const isOnServer = drawer === "server" && store.get().setUp === null;
    if (!isOnServer) {
      world.drawBy(null);
      store.set({ view: !world.canDraw ? "none" : world.hasGraphics ? "open" : "interrupted" });
      return;
    }
    store.set({ view: world.canDraw && world.hasGraphics ? "open" : "starting" });
    const events = {
      onImage: () => store.get().view !== "open" && store.set({ view: "open" }),
      onProblem: fail,
      onNotPushed: () => notify(store, "note", NOT_PUSHED),
    };
    world.drawBy(new DrawnView({ live, fetchImage }, events));
  };
  choice = new ViewChoice(store, { ...options, canDraw: world.canDraw }, use, (sentence) => notify(store, "note", sentence));
  choice.start();
  let isSettingUp = store.get().setUp !== null;
  store.watch(
    ({ setUp }) => setUp !== null,
    (isOn) => {
      if (isOn === isSettingUp) return;
      isSettingUp = isOn;
      if (store.get().drawnBy === "server") use("server");
    },
  );
  return choice;
}

// Waits until the page is visible. In the background it needs no images.
async function untilVisible(): Promise<void> {
  while (document.hidden) {
    await new Promise((resolve) => document.addEventListener("visibilitychange", resolve, { once: true }));
  }
}

function until(store: Store<State>, holds: (state: State) => boolean): Promise<void> {
  if (holds(store.get())) return Promise.resolve();
  return new Promise((resolve) => {
    const unwatch = store.watch(holds, (isTrue) => {
      if (!isTrue) return;
      resolve();
      // The callback may run at once, before `unwatch` is defined.
      queueMicrotask(() => unwatch());
    });
  });
}
