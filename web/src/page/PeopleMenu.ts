// The menu of viewers: the user's own name, the other viewers' names, and who has control.
import type { App } from "../app/App";
import type { People, Person } from "../api/ViewersApi";
import { asker, holderOf, together, youOf } from "../state/people";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";
import { createMenu } from "../ui/menu";

export function createPeopleMenu(app: App): HTMLElement {
  const list = element("ul", { class: "people", "aria-label": "Viewers" });
  const menu = createMenu("Viewers", "people", nameField(app), list, controlButton(app));
  const number = element("span", { class: "number people-count", "aria-hidden": "true" });
  menu.button.append(number);
  app.store.watch(
    ({ people }) => people,
    (people) => {
      menu.element.hidden = people.viewers.length === 0;
      setText(number, people.viewers.length > 1 ? String(people.viewers.length) : "");
      menu.button.classList.toggle("held", holderOf(people) !== null);
      // The accessible name contains the visible number (WCAG 2.5.3).
      menu.button.setAttribute("aria-label", people.viewers.length > 1 ? `Viewers ${people.viewers.length}` : "Viewers");
      menu.button.title = titleOf(people);
      list.replaceChildren(...lines(people).map((line) => element("li", {}, line)));
    },
    (a, b) => JSON.stringify(a) === JSON.stringify(b),
  );
  app.menus.set("viewers", menu.open);
  return menu.element;
}

function titleOf(people: People): string {
  const holder = holderOf(people);
  if (!holder) return "Viewers";
  return holder.number === people.you ? "Viewers (you have control)" : `Viewers (${holder.name} has control)`;
}

// Viewers of other simulations are last, with the name of their simulation.
function lines(people: People): string[] {
  const here = together(people);
  const others = people.viewers.filter((person) => !here.includes(person));
  return [...here.map((person) => line(person, people.you, "")), ...others.map((person) => line(person, people.you, person.simulation))];
}

function line({ number, name, holds, asks }: Person, you: number, simulation: string): string {
  const notes = [
    number === you && "you",
    simulation !== "" && `at ${simulation}`,
    holds && "has control",
    asks > 0 && "asks for control",
  ];
  return [name, ...notes.filter(Boolean)].join(" · ");
}

function nameField(app: App): HTMLElement {
  const field = element("input", { maxlength: "40", autocomplete: "off", spellcheck: "false" });
  field.value = app.people.name;
  field.addEventListener("change", () => void app.people.rename(field.value));
  app.store.watch(
    ({ people }) => youOf(people)?.name ?? "",
    (name) => (field.placeholder = name),
  );
  return element("label", { class: "people-name" }, element("span", {}, "Your name"), field);
}

// The button that requests or releases control. Its text depends on whether you have control or
// wait for it.
function controlButton(app: App): HTMLElement {
  const button = element("button", { class: "button", type: "button" });
  let wants = true;
  app.store.watch(
    ({ people }) => controlWish(people),
    (wish) => {
      button.hidden = wish === null;
      if (!wish) return;
      wants = wish.wants;
      setText(button, wish.label);
    },
    shallowEqual,
  );
  button.addEventListener("click", () => void app.people.want(wants));
  return button;
}

// Returns the label of the button for control, and whether a press requests control. Null if no
// viewer is listed for this simulation.
export function controlWish(people: People): { label: string; wants: boolean } | null {
  if (together(people).length === 0) return null;
  const you = youOf(people);
  const holds = you?.holds ?? false;
  const asks = (you?.asks ?? 0) > 0;
  return { label: labelOf(holds, holderOf(people) === null, asks), wants: !holds && !asks };
}

function labelOf(holds: boolean, isFree: boolean, asks: boolean): string {
  if (isFree) return "Take control";
  if (holds) return "Release control";
  return asks ? "Cancel request" : "Ask for control";
}

// Shows a question to the viewer with control when another viewer requests control: allow or refuse?
// Without an answer in time, the other viewer gets control.
export function createControlQuestion(app: App): HTMLElement {
  const sentence = element("p", {});
  const button = (label: string, grants: boolean, primary: boolean) =>
    element(
      "button",
      {
        class: primary ? "button primary" : "button",
        type: "button",
        onclick: () => void app.people.answer(grants),
      },
      label,
    );
  const card = element(
    "div",
    { class: "card control-question", role: "alert" },
    sentence,
    element("div", {}, button("Give control", true, true), button("Keep control", false, false)),
  );
  let countdown: ReturnType<typeof setInterval> | undefined;
  app.store.watch(
    ({ people }) => asker(people),
    (person) => {
      clearInterval(countdown);
      card.hidden = person === null;
      if (person === null) return;
      const end = performance.now() + person.passesIn * 1000;
      const tell = () => {
        const left = Math.max(0, Math.ceil((end - performance.now()) / 1000));
        setText(sentence, `${person.name} asks for control, and gets it in ${left} s if you do not answer.`);
      };
      tell();
      countdown = setInterval(tell, 1000);
    },
    shallowEqual,
  );
  return card;
}
