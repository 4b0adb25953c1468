// The menu for the real-time factor, and for the number of simulation steps to run.
import type { App } from "../app/App";
import { canAct, isAllowed } from "../state/actions";
import { mayAct } from "../state/people";
import { shallowEqual } from "../state/Store";
import { element } from "../ui/element";
import { numberField } from "../ui/fields";
import { createMenu } from "../ui/menu";

export const FACTORS = [0.1, 0.5, 1, 2, 5, 10];
const FIRST_STEPS = 10;

export function createPaceMenu(app: App): HTMLElement {
  const menu = createMenu("Speed and steps", "gauge", speedPart(app), stepsPart(app));
  app.store.watch(
    ({ status, connection, people }) => status !== null && connection.phase === "open" && mayAct(people),
    (enabled) => (menu.button.disabled = !enabled),
  );
  app.menus.set("pace", menu.open);
  return menu.element;
}

function speedPart(app: App): HTMLElement {
  const set = (factor: number | null) => factor !== null && void app.setFactor(factor);
  const choices = FACTORS.map((factor) => ({
    factor,
    button: element("button", { class: "button small", type: "button", onclick: () => set(factor) }, `${factor}×`),
  }));
  const typed = numberField("Simulated seconds per second of wall-clock time", null, set, { least: "0" });
  const hint = element("p", { class: "hint" }, "In lockstep, the simulation runs as fast as possible. The speed cannot be set.");
  const buttons = element("div", { class: "pace-choices" }, ...choices.map(({ button }) => button));
  app.store.watch(
    ({ status }) => ({ factor: status?.targetFactor ?? 1, isPaced: status?.mode === "real_time" }),
    ({ factor, isPaced }) => {
      for (const each of choices) each.button.setAttribute("aria-pressed", String(each.factor === factor));
      typed.show(factor);
      buttons.hidden = typed.element.hidden = !isPaced;
      hint.hidden = isPaced;
    },
    shallowEqual,
  );
  return element(
    "div",
    { class: "pace-part", role: "group", "aria-label": "Speed" },
    element("h2", {}, "Speed"),
    buttons,
    typed.element,
    hint,
  );
}

function stepsPart(app: App): HTMLElement {
  let count = FIRST_STEPS;
  const take = element(
    "button",
    { class: "button", type: "button", title: "Take this number of steps, then pause", onclick: () => void app.act("step", count) },
    "Take steps",
  );
  const field = numberField(
    "Number of steps to take",
    null,
    (value) => {
      count = Math.max(1, Math.round(value ?? FIRST_STEPS));
      field.show(count);
    },
    { step: "1", least: "1" },
  );
  field.show(count);
  app.store.watch(
    (state) => canAct(state) && isAllowed(state.status?.phase, "step"),
    (enabled) => (take.disabled = !enabled),
  );
  return element(
    "div",
    { class: "pace-part", role: "group", "aria-label": "Steps" },
    element("h2", {}, "Steps"),
    element("div", { class: "field-pair pace-steps" }, field.element, take),
  );
}
