// The controls above the plots.
import { parseExpression } from "../../live/expression";
import type { Curve } from "../../state/plots";
import { MOST_CURVES, ROBOT_VALUES, SIMULATION_VALUES, SPANS, curveName, referenceTo } from "../../state/plots";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "plots">;

// The values of the simulation and of the selected robot. Other values are added elsewhere: values
// of sensors in the inspector, and all other values in the panel of topics.
export function addChoice({ state, plots }: Ports): HTMLElement {
  const choice = element("select", { "aria-label": "Add a curve" });
  const fill = ({ selection, isFull }: { selection: string | null; isFull: boolean }) => {
    choice.replaceChildren(new Option(isFull ? `At most ${MOST_CURVES} curves` : "Add a curve…", ""));
    const group = (label: string, kind: string, values: readonly { key: string; label: string }[]) => {
      const options = element("optgroup", { label });
      options.append(...values.map(({ key, label: name }) => new Option(name, `${kind} ${key}`)));
      choice.append(options);
    };
    if (selection !== null) group(selection, "robot", ROBOT_VALUES);
    group("Simulation", "simulation", SIMULATION_VALUES);
    choice.disabled = isFull;
  };
  choice.addEventListener("change", () => {
    const [kind, key] = choice.value.split(" ");
    choice.value = "";
    const { selection } = state.get();
    if (kind === "simulation") plots.add({ kind: "simulation" }, key!);
    else if (kind === "robot" && selection !== null) plots.add({ kind: "robot", robot: selection }, key!);
  });
  state.watch(
    ({ selection, plots: known }) => ({ selection, isFull: known.curves.length >= MOST_CURVES }),
    fill,
    shallowEqual,
  );
  return choice;
}

export function spanChoice({ state, plots }: Ports): HTMLElement {
  const choice = element("select", { "aria-label": "Time shown" });
  choice.append(
    ...SPANS.map((span) => new Option(span === null ? "All" : `Last ${spanLabel(span)}`, String(span))),
  );
  state.watch(
    ({ replay }) => replay !== null,
    (isReplay) => (choice.options[SPANS.indexOf(null)]!.text = isReplay ? "Whole recording" : "All"),
  );
  choice.addEventListener("change", () => {
    const span = choice.value === "null" ? null : Number(choice.value);
    plots.setSpan(span);
  });
  state.watch(
    (known) => known.plots.span,
    (span) => (choice.value = String(span)),
  );
  return choice;
}

function spanLabel(seconds: number): string {
  return seconds < 120 ? `${seconds} s` : `${seconds / 60} min`;
}

// Selects the horizontal axis: simulated time, or one of the curves.
export function acrossChoice({ state, plots }: Ports): HTMLElement {
  const choice = element("select", { "aria-label": "Horizontal axis", title: "Plot against time, or against a curve" });
  choice.addEventListener("change", () => plots.setAgainst(choice.value === "" ? null : choice.value));
  state.watch(
    ({ plots: { curves, against } }) => ({ curves, against }),
    ({ curves, against }) => {
      choice.replaceChildren(new Option("Against time", ""), ...curves.map((curve) => new Option(`Against ${curveName(curve)}`, curve.id)));
      choice.value = against ?? "";
      choice.disabled = curves.length < 2;
    },
    shallowEqual,
  );
  return choice;
}

export function eventsCheck({ state, plots }: Ports): HTMLElement {
  const box = element("input", { type: "checkbox" });
  box.addEventListener("change", () => plots.showEvents(box.checked));
  state.watch(
    (known) => known.plots.events,
    (isOn) => (box.checked = isOn),
  );
  return element("label", { class: "check-line", title: "Mark events, for example pauses and behaviours that crash" }, box, "Events");
}

// Adds an expression of fields as a curve. Returns the button that opens the form, and the form.
export function expressionForm({ state, plots }: Ports): { button: HTMLElement; form: HTMLElement } {
  const input = element("input", {
    type: "text",
    "aria-label": "Expression",
    placeholder: "{pebble speed} * 3.6",
    spellcheck: "false",
    autocomplete: "off",
    maxlength: "300",
  });
  const field = element("select", { "aria-label": "Insert a field" });
  field.addEventListener("change", () => {
    input.setRangeText(field.value, input.selectionStart ?? input.value.length, input.selectionEnd ?? input.value.length, "end");
    field.value = "";
    input.focus();
  });
  state.watch(
    ({ plots: { curves } }) => curves,
    (curves) => field.replaceChildren(new Option("Insert a field…", ""), ...fieldsOf(curves)),
  );
  const wrong = element("p", { class: "field-error", role: "alert" });
  const add = () => {
    const text = input.value.trim();
    try {
      if (parseExpression(text).references.length === 0) throw new Error("The expression needs a field, for example {pebble speed}.");
      if (state.get().plots.curves.length >= MOST_CURVES) throw new Error(`The plot has ${MOST_CURVES} curves already. Remove one first.`);
    } catch (error) {
      return setText(wrong, (error as Error).message);
    }
    setText(wrong, "");
    input.value = "";
    plots.add({ kind: "expression" }, text, "");
  };
  const submit = element("button", { class: "button", type: "submit" }, "Add");
  const form = element("form", { class: "plot-expression" }, input, field, submit, wrong);
  form.hidden = true;
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    add();
  });
  const button = element(
    "button",
    { class: "button plain", type: "button", title: "Plot an expression of fields", "aria-expanded": "false" },
    "Expression…",
  );
  button.addEventListener("click", () => {
    form.hidden = !form.hidden;
    button.setAttribute("aria-expanded", String(!form.hidden));
    if (!form.hidden) input.focus();
  });
  return { button, form };
}

function fieldsOf(curves: readonly Curve[]): HTMLElement[] {
  return curves.map((curve) => new Option(curveName(curve), referenceTo(curve)));
}
