// A line that explains why commands need control of the simulation. Its button requests control.
import { holderOf, needsControl, youOf } from "../../state/people";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { PanelPorts } from "../contract/ports";

// `follow` calls a function on each change. It returns a function that ends these calls.
export function controlLine(state: PanelPorts["state"], control: Pick<PanelPorts["control"], "take">) {
  const sentence = element("span");
  const button = element("button", { class: "button", type: "button", onclick: () => void control.take() });
  const line = element("p", { class: "control-line", role: "status" }, sentence, button);
  const follow = () =>
    state.watch(
      ({ people }) => ({
        reason: needsControl(people),
        isFree: holderOf(people) === null,
        asks: (youOf(people)?.asks ?? 0) > 0,
      }),
      ({ reason, isFree, asks }) => {
        line.hidden = reason === "";
        setText(sentence, asks ? `${reason} You have asked for control.` : reason);
        setText(button, isFree ? "Take control" : "Ask for control");
        button.hidden = asks;
      },
      shallowEqual,
    );
  return { line, follow };
}
