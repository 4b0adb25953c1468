// Covers the view if there is nothing to show. Explains the reason, and what the user can do.
import type { App } from "../app/App";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import { element } from "../ui/element";
import { createEndCard as endCard } from "./EndCard";
import { createTokenForm } from "../ui/tokenForm";

type Situation = "refused" | "missing" | "none" | "connecting" | "unreachable" | "lost" | "ended" | "no-simulation" | "loading" | "no-webgl" | "not-drawn" | "webgl-lost";

// Whether the run is over. It is still over after the server has ended. A replay can start again,
// so a replay is never over.
export function hasEnded({ status, replay }: State): boolean {
  return replay === null && (status?.phase === "finished" || status?.phase === "failed");
}

// Returns the data for the summary of an ended run.
function whatEnded(state: State): string {
  const { connection, recording, abilities, expectations } = state;
  if (!hasEnded(state)) return "";
  const isThere = connection.phase === "open";
  return [isThere, recording?.path, abilities.recordings, ...expectations.map(({ verdict }) => verdict)].join(" ");
}

export function situationOf(state: State): Situation {
  const { connection, simulations, simulation, view, setUp, missing, refusal } = state;
  // while the view starts, nothing is shown of the scene
  const scene = view === "starting" ? null : state.scene;
  if (refusal !== "") return "refused";
  if (missing !== "") return "missing";
  if (setUp) {
    if (view === "none") return noViewOf(state);
    return view === "interrupted" ? "webgl-lost" : scene ? "none" : "loading";
  }
  if (state.scene && hasEnded(state)) return state.endSeen ? "none" : "ended";
  if (connection.phase !== "open" && state.scene) return "lost";
  if (connection.phase === "waiting") return "unreachable";
  if (simulations !== null && simulations.length === 0 && simulation === null) return "no-simulation";
  if (view === "none") return noViewOf(state);
  if (view === "interrupted") return "webgl-lost";
  if (scene) return "none";
  return simulation === null ? "connecting" : "loading";
}

// The browser cannot draw. "not-drawn": the server has refused to draw, with a reason.
function noViewOf({ whyNoView }: State): Situation {
  return whyNoView === "" ? "no-webgl" : "not-drawn";
}

export function createOverlay(app: App): HTMLElement {
  const place = element("div", { class: "overlay", "aria-live": "polite" });
  app.store.watch(
    (state) => ({ situation: situationOf(state), of: whatEnded(state), reason: state.whyNoView }),
    ({ situation }) => {
      place.hidden = situation === "none";
      place.dataset.situation = situation;
      place.replaceChildren(...content(app, situation));
    },
    shallowEqual,
  );
  return place;
}

function content(app: App, situation: Situation): Node[] {
  switch (situation) {
    case "none":
      return [];
    case "refused":
      return [message("This server requires a token", app.store.get().refusal, createTokenForm((token) => app.enterToken(token)))];
    case "missing":
      return [
        message(
          "Recording not found",
          app.store.get().missing,
          element("a", { class: "button", href: "recordings.html" }, "All recordings"),
        ),
      ];
    case "connecting":
      return [message("Connecting to GSV…")];
    case "loading":
      return [message("Loading the scene…")];
    case "no-webgl":
      return [
        message(
          "This browser cannot show 3D graphics",
          "WebGL 2 is not available. For the 3D view, use another browser or turn on graphics acceleration. All other parts of the page work.",
        ),
      ];
    case "not-drawn":
      return [
        message(
          "The server does not draw the view",
          app.store.get().whyNoView,
          "This browser has no WebGL, so it cannot draw the view either. All other parts of the page work.",
          element("button", { class: "button", type: "button", onclick: () => app.askServerAgain() }, "Try again"),
        ),
      ];
    case "webgl-lost":
      return [
        message(
          "The 3D view has stopped",
          "The browser lost access to the graphics card. The view returns when the browser restores access. The simulation continues, and all other parts of the page work.",
          element("button", { class: "button", type: "button", onclick: () => location.reload() }, "Reload the page"),
        ),
      ];
    case "no-simulation":
      return [
        message(
          "No simulation yet",
          createButton(app),
          recordingsLink(app),
          "Create a simulation here, or start one in a terminal. It appears here automatically.",
          element("code", {}, "gsv run WORLD --robot MODEL@x,y --behaviour wander"),
        ),
      ];
    case "ended":
      return [endCard(app)];
    case "unreachable":
      return [
        message(
          "Cannot reach GSV",
          `No response from ${location.host}. Check that gsv still runs there.`,
          retry(app),
        ),
      ];
    case "lost":
      return [
        message(
          "Connection lost",
          "The view shows the last known state. The page reconnects when GSV responds.",
          retry(app),
        ),
      ];
  }
}

// There is no link if the server has no recordings.
function recordingsLink(app: App): HTMLElement {
  const link = element("a", { class: "button", href: "recordings.html" }, "Open a recording");
  const unwatch = app.store.watch(
    ({ abilities }) => abilities.recordings,
    (recordings) => {
      if (link.parentElement && !link.isConnected) return unwatch();
      link.hidden = !recordings;
    },
  );
  return link;
}

// There is no button if the server cannot create simulations.
function createButton(app: App): HTMLElement {
  const button = element(
    "button",
    { class: "button primary", type: "button", onclick: () => void app.setUp.open() },
    "Create a simulation",
  );
  const unwatch = app.store.watch(
    ({ abilities }) => abilities.creates,
    (creates) => {
      if (button.parentElement && !button.isConnected) return unwatch();
      button.hidden = !creates;
    },
  );
  return button;
}

function message(title: string, ...more: (string | Node)[]): HTMLElement {
  const parts = more.map((part) => (typeof part === "string" ? element("p", {}, part) : part));
  return element("div", { class: "card message" }, element("h2", {}, title), ...parts);
}

function retry(app: App): HTMLElement {
  const countdown = element("span", { class: "dim number" });
  const unwatch = app.store.watch(
    ({ connection }) => connection,
    (connection) => {
      if (countdown.parentElement && !countdown.isConnected) return unwatch();
      countdown.textContent =
        connection.phase === "waiting"
          ? `next attempt in ${Math.max(1, Math.round((connection.retryAtMs - Date.now()) / 1000))} s`
          : "trying…";
    },
    shallowEqual,
  );
  return element(
    "div",
    { class: "retry" },
    element("button", { class: "button", type: "button", onclick: () => app.session.retryNow() }, "Try now"),
    countdown,
  );
}
