// The line that says that the simulation is paused. Its button resumes the simulation.
import { mainAction } from "../../state/actions";
import { needsControl } from "../../state/people";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { PanelPorts } from "../contract/ports";

// `consequence` is a sentence on what a paused simulation means for this panel. `follow` calls a
// function on each change. It returns a function that ends these calls.
export function resumeLine(state: PanelPorts["state"], control: Pick<PanelPorts["control"], "resume">, consequence: string) {
  const sentence = element("span");
  const button = element("button", { class: "button", type: "button", onclick: () => control.resume() });
  const line = element("p", { class: "control-line", role: "status" }, sentence, button);
  const follow = () =>
    state.watch(
      ({ status, replay, people }) => ({ phase: replay ? undefined : status?.phase, isRefused: needsControl(people) !== "" }),
      ({ phase, isRefused }) => {
        line.hidden = phase !== "paused" && phase !== "created";
        button.disabled = isRefused;
        setText(sentence, `The simulation ${phase === "paused" ? "is paused" : "has not started"}. ${consequence}`.trim());
        setText(button, mainAction(phase) === "resume" ? "Resume" : "Start");
      },
      shallowEqual,
    );
  return { line, follow };
}
