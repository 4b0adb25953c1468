// The summary of a run that has ended, with a link to its replay.
import type { App } from "../app/App";
import { replayUrl } from "../recordings/recordings";
import { summaryOf } from "../state/expectations";
import { SHOWN_STATES, STATE_WORDS, isTrouble } from "../state/health";
import { listedRobots } from "../state/listedRobots";
import type { State } from "../state/State";
import { element } from "../ui/element";
import { count, formatTime } from "../ui/format";

export function createEndCard(app: App): HTMLElement {
  const state = app.store.get();
  const { status, connection } = state;
  const isFailed = status?.phase === "failed";
  const close = element(
    "button",
    { class: "button", type: "button", onclick: () => app.store.set({ endSeen: true }) },
    "Show the view",
  );
  const again = element(
    "button",
    { class: "button", type: "button", onclick: () => void app.act("reset") },
    "Reset",
  );
  return element(
    "div",
    { class: "card message" },
    element("h2", {}, isFailed ? "Failed" : "Finished"),
    element("div", { class: "ended-facts" }, ...endFacts(state).map((fact) => element("p", {}, fact))),
    replayOf(state),
    connection.phase === "open" && again,
    close,
  );
}

// Returns facts such as "5 robots · 1:00.00 simulated", "2 robots stuck" and "Expectations: 3 of 5
// held".
export function endFacts(state: State): string[] {
  const { status, time, expectations } = state;
  const robots = listedRobots(state);
  const collisions = robots.reduce((sum, { status: { collisions: its } }) => sum + its, 0);
  const sizes = [count(robots.length, "robot"), `${formatTime(time)} simulated`, count(collisions, "collision")];
  const troubles = SHOWN_STATES.filter(isTrouble).flatMap((shown) => {
    const those = robots.filter((robot) => robot.state === shown);
    return those.length === 0 ? [] : [`${count(those.length, "robot")} ${STATE_WORDS[shown]}: ${someOf(those.map((each) => each.status.name))}`];
  });
  const verdict = summaryOf(expectations);
  return [status?.failure ?? "", sizes.join(" · "), ...troubles, verdict && `Expectations: ${verdict}`].filter(Boolean);
}

const MOST_NAMES = 5;

function someOf(names: string[]): string {
  const more = names.length - MOST_NAMES;
  return names.slice(0, MOST_NAMES).join(", ") + (more > 0 ? ` and ${count(more, "other")}` : "");
}

// Returns a link to the replay while the server runs. Afterwards, returns a command with the same
// effect.
function replayOf({ recording, abilities, connection }: State): HTMLElement | null {
  if (!recording?.path) return null;
  const name = recording.path.slice(recording.path.lastIndexOf("/") + 1);
  if (connection.phase === "open" && abilities.recordings) {
    return element("a", { class: "button primary", href: replayUrl(name) }, "Replay");
  }
  return element("p", {}, "Replay it with:", element("code", {}, `gsv replay ${recording.path}`));
}
