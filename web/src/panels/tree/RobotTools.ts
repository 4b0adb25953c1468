// The controls above the list of robots: search, order and groups.
import type { State } from "../../state/State";
import type { Grouping, Sorting } from "../../state/robotList";
import { isFiltering, queryOf } from "../../state/robotList";
import { STATE_WORDS } from "../../state/health";
import { element, setText } from "../../ui/element";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "robots">;

// If there are at least this many robots, the search field is shown.
const FEWEST_ROBOTS = 6;

const SORTING_LABELS: Record<Sorting, string> = {
  worst: "Worst state first",
  name: "Sort by name",
  distance: "Longest distance first",
  collisions: "Most collisions first",
};
const GROUPING_LABELS: Record<Grouping, string> = {
  none: "No groups",
  namespace: "Group by namespace",
  model: "Group by model",
  state: "Group by state",
  behaviour: "Group by behaviour",
};

export function createRobotTools(ports: Ports): HTMLElement {
  const field = searchField(ports);
  const problem = element("p", { class: "robot-problem", role: "status" });
  const chip = element("button", { class: "button small robot-chip", type: "button", title: "Show robots in all states" });
  chip.addEventListener("click", () => ports.robots.filter({ state: null }));
  const sorting = choice<Sorting>("Order", SORTING_LABELS, (chosen) => ports.robots.filter({ sorting: chosen }));
  const grouping = choice<Grouping>("Groups", GROUPING_LABELS, (chosen) => ports.robots.filter({ grouping: chosen }));
  const tools = element(
    "div",
    { class: "robot-tools" },
    field,
    problem,
    chip,
    element("div", { class: "robot-choices" }, sorting, grouping),
  );
  ports.state.watch(
    ({ robotFilter }) => robotFilter,
    (filter) => {
      if (field.value !== filter.text) field.value = filter.text;
      sorting.value = filter.sorting;
      grouping.value = filter.grouping;
      setText(problem, queryOf(filter.text).problem);
      chip.hidden = filter.state === null;
      setText(chip, filter.state === null ? "All states" : `Only ${STATE_WORDS[filter.state]} ×`);
    },
  );
  ports.state.watch(isOfUse, (isShown) => (tools.hidden = !isShown));
  return tools;
}

function isOfUse({ status, robotFilter }: State): boolean {
  return (status?.robots.length ?? 0) >= FEWEST_ROBOTS || isFiltering(robotFilter);
}

function searchField(ports: Ports): HTMLInputElement {
  const field = element("input", {
    type: "search",
    class: "robot-search",
    "aria-label": "Search robots",
    placeholder: "name, state:stuck, /^a\\d/",
    title: "Words of the name, or FIELD:WORD with name, ns, model, behaviour or state. /…/ is a regular expression.",
    autocomplete: "off",
    spellcheck: "false",
  });
  field.addEventListener("input", () => ports.robots.filter({ text: field.value }));
  return field;
}

function choice<Value extends string>(label: string, labels: Record<Value, string>, choose: (value: Value) => void): HTMLSelectElement {
  const made = element("select", { "aria-label": label, title: label });
  for (const [value, text] of Object.entries<string>(labels)) made.append(new Option(text, value));
  made.addEventListener("change", () => choose(made.value as Value));
  return made;
}

