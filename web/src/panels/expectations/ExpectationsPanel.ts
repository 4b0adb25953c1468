// The expectations of the scenario with verdict, margin and time. In a recording, a click on an
// expectation goes to this time.
import type { Expectation } from "../../state/expectations";
import { marginText, summaryOf, verdictWord } from "../../state/expectations";
import { shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import { formatTime } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "replay" | "robots">;

const NOTHING = "This run has no expectations. List them under `expect` in the scenario file.";

export function mount(ports: Ports): MountedPanel {
  const list = element("ul", { class: "expectations", "aria-label": "Expectations" });
  const summary = element("span", { class: "dim" });
  const show = (expectations: readonly Expectation[]) => {
    summary.textContent = summaryOf(expectations);
    list.replaceChildren(...expectations.map((each) => row(ports, each)));
    if (expectations.length === 0) list.replaceChildren(element("li", { class: "hint" }, NOTHING));
  };
  return {
    body: list,
    tools: [summary],
    whileOpen: () =>
      ports.state.watch(
        ({ expectations, replay, scene }) => ({ expectations, isReplay: replay !== null, scene }),
        ({ expectations }) => show(expectations),
        shallowEqual,
      ),
  };
}

function row(ports: Ports, expectation: Expectation): HTMLElement {
  const { name, yaml, where, verdict, detail } = expectation;
  const margin = marginText(expectation);
  return element(
    "li",
    { class: "expectation", "data-verdict": verdict },
    element("span", { class: "mark-of", "aria-hidden": "true" }),
    element("span", { class: "expectation-name", title: where }, name || yaml),
    element("span", { class: "number dim", title: "Smallest distance of the value to its limit while the expectation applies, and when it occurred. For a condition that needs to become true only once, this is the largest distance instead." }, margin && `margin ${margin}`),
    element("span", { class: "expectation-state" }, verdictWord(verdict), instant(ports, expectation)),
    detail !== "" && element("span", { class: "expectation-text" }, detail),
    element("span", { class: "expectation-text" }, name === yaml ? "" : yaml, ...expectation.bodies.flatMap((body) => [" ", bodyButton(ports, body)])),
  );
}

// Shows the time of the verdict. In a recording, a click goes to this time.
function instant({ state, replay }: Ports, { verdict, time }: Expectation): Node | string {
  if (verdict === "pending") return "";
  const text = formatTime(time);
  if (!state.get().replay) return ` at ${text}`;
  const title = "Go to this time";
  return element("button", { class: "button plain small", type: "button", title, onclick: () => void replay.seek(time) }, text);
}

function bodyButton({ state, robots }: Ports, body: string): Node | string {
  const isRobot = state.get().scene?.bodies.some(({ name, isRobot: is, isAvatar }) => name === body && (is || isAvatar));
  if (!isRobot) return "";
  const title = "Select this robot";
  return element("button", { class: "button plain small", type: "button", title, onclick: () => robots.select(body) }, body);
}
