// The status bar: phase, time, real-time factor, the behaviour that delays the run, and the
// connection.
import type { App } from "../app/App";
import type { Replay } from "../api/replay";
import type { SimulationStatus } from "../api/status";
import type { State } from "../state/State";
import { phaseLabel } from "../state/actions";
import { shallowEqual } from "../state/Store";
import { hasEnded } from "./Overlay";
import { element, setText } from "../ui/element";
import { count, formatFactor, formatTime } from "../ui/format";

const PACE = "Real-time factor: actual / target";
// A simulation is too slow if it runs below this fraction of its target factor.
const LAGGING_SHARE = 0.9;

export function createStatusBar(app: App): HTMLElement {
  const phase = element("span", { class: "phase", role: "status", "data-testid": "phase" });
  const time = element("span", { class: "time number", "data-testid": "time", title: "Simulated time" });
  const factor = element("span", {
    class: "number",
    "data-testid": "factor",
    title: PACE,
  });
  const late = element("span", {
    class: "number late",
    "data-testid": "late",
    title: "Late steps: they started later than the next step was due",
  });
  const waiting = element("span", { class: "waiting", role: "status", "data-testid": "waiting" });
  const connection = element("span", { class: "connection", role: "status", "data-testid": "connection" });
  const problem = element("span", { class: "waiting", role: "status", "data-testid": "connection-problem" });
  const frames = element("span", { class: "number dim frames", title: "Frames drawn in the last second" });

  app.store.watch(
    ({ status }) => status?.phase,
    (value) => {
      phase.dataset.phase = value ?? "";
      setText(phase, value ? phaseLabel(value) : "–");
    },
  );
  app.store.watch(
    ({ time: value, status }) => (status ? formatTime(value) : ""),
    (text) => setText(time, text),
  );
  app.store.watch(
    ({ status, replay }) => (status ? pace(status, replay) : ""),
    (text) => setText(factor, text),
  );
  app.store.watch(
    ({ status }) => (status ? lag(status) : ""),
    (text) => {
      factor.classList.toggle("lagging", text !== "");
      factor.title = text || PACE;
    },
  );
  app.store.watch(
    ({ status }) => status?.lateSteps ?? 0,
    (steps) => setText(late, steps > 0 ? count(steps, "late step") : ""),
  );
  app.store.watch(
    ({ status }) => status?.failure || (status?.waitingFor ? `waiting for ${status.waitingFor}` : ""),
    (text) => setText(waiting, text),
  );
  app.store.watch(
    (state) => ({ phase: state.connection.phase, text: connectionLabel(state) }),
    ({ phase: value, text }) => {
      connection.dataset.phase = value;
      setText(connection, text);
    },
    shallowEqual,
  );
  app.store.watch(
    ({ connectionProblem }) => connectionProblem,
    (text) => {
      setText(problem, text);
      problem.title = text;
    },
  );
  app.store.watch(
    ({ framesPerSecond }) => Math.round(framesPerSecond),
    (value) => setText(frames, value > 0 ? `${value} fps` : ""),
  );
  return element("footer", { class: "status-bar" }, phase, time, factor, late, waiting, problem, frames, connection);
}

// Returns the text about the speed. In lockstep, there is only an actual factor, and no target
// factor. A replay has its own speed.
function pace({ mode, realTimeFactor, targetFactor }: SimulationStatus, replay: Replay | null): string {
  if (replay) return formatFactor(replay.speed);
  const actual = formatFactor(realTimeFactor);
  return mode === "lockstep" ? `${actual} · lockstep` : `${actual} / ${formatFactor(targetFactor)}`;
}

// Returns a sentence if the simulation is slower than its target, otherwise an empty text.
function lag({ phase, mode, realTimeFactor, targetFactor }: SimulationStatus): string {
  const isPaced = phase === "running" && mode === "real_time" && targetFactor > 0 && realTimeFactor > 0;
  if (!isPaced || realTimeFactor >= LAGGING_SHARE * targetFactor) return "";
  const share = Math.floor((100 * realTimeFactor) / targetFactor);
  return `Running at ${share} % of the target speed`;
}

function connectionLabel(state: State): string {
  const { connection, modelsMissing, replay } = state;
  if (connection.phase !== "open" && hasEnded(state)) return "Server ended";
  if (connection.phase === "connecting") return "Connecting…";
  if (connection.phase === "waiting") return "Connection lost";
  return modelsMissing > 0 ? `Loading ${count(modelsMissing, "model")}…` : replay ? "Replay" : "Live";
}
