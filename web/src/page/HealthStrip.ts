// The states of all robots in one line: the number of robots in each state, and the expectations. A
// click on a state shows only the robots in this state, in the list and in the view.
import type { App } from "../app/App";
import type { ListedRobot } from "../state/robotList";
import { listedRobots } from "../state/listedRobots";
import type { ShownState } from "../state/health";
import { SHOWN_STATES, STATE_WORDS } from "../state/health";
import { summaryOf } from "../state/expectations";
import { shallowEqual } from "../state/Store";
import { element, setAttribute, setText } from "../ui/element";

const EXPECTATIONS_PANEL = "expectations";
// The order of the states. Robots that move are first. The other states follow, from the worst to
// the best.
const ORDER: readonly ShownState[] = ["moving", ...SHOWN_STATES.filter((state) => state !== "moving")];

export function createHealthStrip(app: App): HTMLElement {
  const chips = new Map(ORDER.map((state) => [state, chip(app, state)]));
  const verdict = element("button", {
    class: "button small verdict",
    type: "button",
    title: "Show the expectations",
    onclick: () => app.panels.open(EXPECTATIONS_PANEL),
  });
  const strip = element(
    "section",
    { class: "health-strip", "aria-label": "Robot states" },
    ...[...chips.values()].map(({ button }) => button),
    element("span", { class: "spacer" }),
    verdict,
  );
  app.store.watch(
    ({ status, health, scene }) => ({ robots: status?.robots, health, scene }),
    () => {
      const counts = countsOf(listedRobots(app.store.get()));
      for (const [state, { show }] of chips) show(counts.get(state) ?? 0);
    },
    shallowEqual,
  );
  app.store.watch(
    ({ expectations }) => expectations,
    (expectations) => {
      const text = summaryOf(expectations);
      verdict.hidden = text === "";
      verdict.dataset.verdict = expectations.some((each) => each.verdict === "violated") ? "violated" : "";
      setText(verdict, `Expectations: ${text}`);
    },
  );
  app.store.watch(
    ({ setUp, health, expectations }) => setUp !== null || (health === null && expectations.length === 0),
    (hidden) => (strip.hidden = hidden),
  );
  return strip;
}

// Stations are counted only if they are dead, because they have no drive.
function countsOf(robots: readonly ListedRobot[]): Map<ShownState, number> {
  const counts = new Map<ShownState, number>();
  for (const { state, kind } of robots) {
    if (kind !== "station" || state === "dead") counts.set(state, (counts.get(state) ?? 0) + 1);
  }
  return counts;
}

function chip(app: App, state: ShownState) {
  const number = element("span", { class: "number" });
  const button = element(
    "button",
    {
      class: "button small",
      type: "button",
      "data-state": state,
      title: `Show only robots that are ${STATE_WORDS[state]}; press again to show all`,
      onclick: () => app.filterRobots({ state: app.store.get().robotFilter.state === state ? null : state }),
    },
    element("span", { class: "dot", "data-state": state, "aria-hidden": "true" }),
    number,
    ` ${STATE_WORDS[state]}`,
  );
  let count = 0;
  const place = () => {
    const isChosen = app.store.get().robotFilter.state === state;
    const isHidden = count === 0 && !isChosen;
    if (button.hidden !== isHidden) button.hidden = isHidden;
    setAttribute(button, "aria-pressed", String(isChosen));
  };
  app.store.watch(({ robotFilter }) => robotFilter.state === state, place);
  const show = (value: number) => {
    count = value;
    setText(number, String(value));
    place();
  };
  return { button, show };
}
