// The joints of a robot or an arm: the position of each joint between its limits, and a slider that
// commands the joint.
import type { BodyJoints } from "../../api/joints";
import { shownPart } from "../../state/parts";
import { needsControl } from "../../state/people";
import type { State } from "../../state/State";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { controlLine } from "../control/controlLine";
import { resumeLine } from "../control/resumeLine";
import { JointRow } from "./JointRow";

type Ports = Pick<PanelPorts, "state" | "control">;

const UPDATE_MS = 200; // period of updates, so that numbers can be read
const NO_BODY = "No body has joints. Add a robot or an object with joints.";

export function mount({ state, control }: Ports): MountedPanel {
  const choice = element("select", { "aria-label": "Body" });
  const degrees = element("input", { type: "checkbox" });
  const note = element("p", { class: "dim joints-note", role: "status" });
  const { line, follow } = controlLine(state, control);
  const paused = resumeLine(state, control, "Commands are applied when it runs.");
  const list = element("ul", { class: "joint-list", "aria-label": "Joints" });
  let rows: JointRow[] = [];
  let body: string | null = null;
  setText(note, NO_BODY);
  let names = "";
  let time = 0; // time of the last report, s

  let refusedWith = ""; // why the last command was refused
  const problem = (sentence: string) => setText(note, (refusedWith = sentence));
  const command = (joint: string, kind: "position" | "velocity", value: number): Promise<void> => {
    const { simulation } = state.get();
    if (simulation === null || body === null) return Promise.resolve();
    return control.commandJoint(simulation, body, joint, kind, value).then(() => void (refusedWith = ""));
  };
  const show = (told: BodyJoints) => {
    const now = JSON.stringify([body, told.joints.map(({ name }) => name)]);
    if (now !== names) {
      names = now;
      rows = told.joints.map((joint) => new JointRow(joint, { command, problem }));
      list.replaceChildren(...rows.map((row) => row.element));
    }
    const { status, people } = state.get();
    const isRefused = told.refusal !== "" || needsControl(people) !== "";
    const isPaused = status?.phase === "created" || status?.phase === "paused";
    if (told.time < time) for (const row of rows) row.forget(); // the simulation was reset
    time = told.time;
    rows.forEach((row, i) => row.show(told.joints[i]!, { isRefused, isPaused, inDegrees: degrees.checked }));
    setText(note, told.refusal || refusedWith || (told.joints.length === 0 ? "This body has no joint that accepts commands." : ""));
  };
  const forget = (sentence: string) => {
    names = refusedWith = "";
    rows = [];
    list.replaceChildren();
    setText(note, sentence);
  };

  let timer: ReturnType<typeof setTimeout> | undefined;
  const ask = async () => {
    const { simulation } = state.get();
    const asked = body;
    if (simulation !== null && asked !== null) {
      try {
        const told = await control.joints(simulation, asked);
        if (asked === body && timer !== undefined) show(told);
      } catch (error) {
        if (asked === body) setText(note, (error as Error).message);
      }
    }
    if (timer === undefined) return;
    clearTimeout(timer);
    timer = setTimeout(() => void ask(), UPDATE_MS);
  };
  const choose = (name: string | null) => {
    if (name === body) return;
    body = name;
    choice.value = name ?? "";
    forget(name === null ? NO_BODY : "");
  };
  choice.addEventListener("change", () => choose(choice.value));

  const whileOpen = () => {
    timer = setTimeout(() => void ask(), 0);
    const ends = [
      follow(),
      paused.follow(),
      state.watch(
        jointedBodies,
        (bodies) => {
          choice.replaceChildren(...bodies.map((name) => new Option(name, name)));
          choice.hidden = bodies.length === 0;
          const selection = selected(state.get());
          const isThere = (name: string | null): name is string => name !== null && bodies.includes(name);
          choose(isThere(body) ? body : isThere(selection) ? selection : (bodies[0] ?? null));
          choice.value = body ?? "";
        },
        shallowEqual,
      ),
      state.watch(
        selected,
        (selection) => selection !== null && jointedBodies(state.get()).includes(selection) && choose(selection),
      ),
    ];
    return () => {
      clearTimeout(timer);
      timer = undefined;
      ends.forEach((end) => end());
    };
  };
  const inDegrees = element("label", { class: "check-line", title: "Show angles in degrees" }, degrees, "Degrees");
  return { body: element("div", { class: "joints-body" }, line, paused.line, note, list), tools: [choice, inDegrees], whileOpen };
}

// Returns the body in the inspector. If the inspector shows a part of a body, returns this body.
function selected(state: State): string | null {
  return shownPart(state)?.body ?? null;
}

// Returns the bodies with joints: first robots, then arms and other objects. Static bodies are left
// out, because their joints do not move.
function jointedBodies({ scene }: State): string[] {
  const jointed = (scene?.bodies ?? []).filter(({ joints }) => joints.length > 0);
  return [...jointed.filter(({ isRobot }) => isRobot), ...jointed.filter(({ isRobot }) => !isRobot)].map(({ name }) => name);
}
