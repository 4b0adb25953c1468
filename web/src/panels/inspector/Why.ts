// Explains the state of the selected robot: a sentence, the last command, the motion, and the
// nearest obstacle.
import type { RobotHealth, ShownState } from "../../state/health";
import { STATE_WORDS, motionText, sentenceOf, stateOf } from "../../state/health";
import type { State } from "../../state/State";
import { element, setAttribute, setText } from "../../ui/element";
import { formatTime, formatValue } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";

const ROWS = ["Commanded", "Actual", "Nearest obstacle", "Touches", "Since"] as const;
type Row = (typeof ROWS)[number];

interface Shown {
  sentence: string;
  state: ShownState;
  rows: Record<Row, string>; // if a text is empty, its row is left out
}

export function createWhy({ state }: Pick<PanelPorts, "state">): HTMLElement {
  const dot = element("span", { class: "dot" });
  const sentence = element("span", {});
  const values = new Map(ROWS.map((row) => [row, { term: element("dt", {}, row), value: element("dd", {}) }]));
  const list = element("dl", {}, ...[...values.values()].flatMap(({ term, value }) => [term, value]));
  const made = element(
    "section",
    { class: "why", "aria-label": "State of the robot" },
    element("p", { class: "why-sentence", role: "status" }, dot, sentence),
    list,
  );
  state.watch(
    shownOf,
    (shown) => {
      made.hidden = shown === null;
      if (!shown) return;
      setAttribute(dot, "data-state", shown.state);
      setText(sentence, shown.sentence);
      for (const [row, { term, value }] of values) {
        term.hidden = value.hidden = shown.rows[row] === "";
        setText(value, shown.rows[row]);
      }
    },
    (a, b) => JSON.stringify(a) === JSON.stringify(b),
  );
  return made;
}

function shownOf({ health, selection, time, status }: State): Shown | null {
  const robot = status?.robots.find(({ name }) => name === selection);
  if (!health || !robot) return null;
  const known = health.robots.get(robot.name) ?? null;
  const shown = stateOf(health, robot);
  const sentence = (known && sentenceOf(known, time)) || STATE_WORDS[shown];
  return { state: shown, sentence, rows: known ? rowsOf(known) : NO_ROWS };
}

const NO_ROWS: Record<Row, string> = { Commanded: "", Actual: "", "Nearest obstacle": "", Touches: "", Since: "" };

function rowsOf({ command, actual, limit, contact, since }: RobotHealth): Record<Row, string> {
  return {
    Commanded: motionText(command.linear, command.angular, command.lateral),
    Actual: motionText(actual.linear, actual.angular),
    "Nearest obstacle": limit ? `${limit.sensor} reads ${Number.isFinite(limit.value) ? formatValue(limit.value, limit.unit) : "less than its minimum range"}` : "",
    Touches: contact,
    Since: formatTime(since),
  };
}
