// @vitest-environment jsdom
import { afterEach, expect, test } from "vitest";
import { choiceField, choiceOrText, numberField, textField } from "./fields";

afterEach(() => document.body.replaceChildren());

function controlOf<T extends HTMLElement>(field: { element: HTMLElement }, selector: string): T {
  document.body.append(field.element);
  return field.element.querySelector<T>(selector)!;
}

// The events that a browser sends when the user types into a field and leaves it.
function type(input: HTMLInputElement, text: string): void {
  input.focus();
  input.value = text;
  input.dispatchEvent(new Event("input"));
}

function leave(input: HTMLInputElement, isChanged: boolean): void {
  if (isChanged) input.dispatchEvent(new Event("change"));
  input.blur();
}

test("typed text is kept when another value is shown, and applies when typing is finished", () => {
  const taken: string[] = [];
  const field = textField("Name", "", (text) => taken.push(text));
  const input = controlOf<HTMLInputElement>(field, "input");
  field.show("pebble");
  type(input, "sco");
  field.show("pebble"); // the server has answered
  expect(input.value).toBe("sco");
  type(input, "scout");
  leave(input, true);
  expect(taken).toEqual(["scout"]);
  field.show("scout");
  field.show("other"); // for example because the user undid the change
  expect(input.value).toBe("other");
});

test("text that was typed back to its former value is replaced by a newer value", () => {
  const field = numberField("x (m)", null, () => {});
  const input = controlOf<HTMLInputElement>(field, "input");
  field.show(1);
  type(input, "12");
  field.show(2.5); // the user dragged the robot in the view
  type(input, "1");
  leave(input, false);
  expect(input.value).toBe("2.5");
});

test("an open list keeps its options while they are equal", () => {
  const field = choiceField("Moves", () => {});
  const select = controlOf<HTMLSelectElement>(field, "select");
  const options = () => [{ value: "a", label: "A" }, { value: "b", label: "B" }];
  field.offer(options());
  field.show("b");
  const first = select.options[0];
  field.offer(options());
  expect(select.options[0]).toBe(first);
  field.offer([...options(), { value: "c", label: "C" }]);
  expect(select.options.length).toBe(3);
  expect(select.value).toBe("b");
});

test("a constraint can be typed while offers change", () => {
  const taken: string[] = [];
  const field = choiceOrText("Behaviour", { choice: "By constraint…", placeholder: "" }, (value) => taken.push(value));
  const select = controlOf<HTMLSelectElement>(field, "select");
  const input = field.element.querySelector("input")!;
  const none = { value: "", label: "None" };
  const wander = { value: "wander", label: "wander" };
  field.offer([none]);
  field.show("");
  expect(input.hidden).toBe(true);

  select.selectedIndex = 1;
  select.dispatchEvent(new Event("change"));
  field.offer([none, wander]);
  field.show("");
  expect(input.hidden).toBe(false);
  expect(select.selectedOptions[0]!.label).toBe("By constraint…");

  type(input, "name == ");
  field.offer([none]);
  field.show("");
  expect(input.hidden).toBe(false);
  expect(input.value).toBe("name == ");

  type(input, "name == 'wander'");
  leave(input, true);
  expect(taken).toEqual(["name == 'wander'"]);
});

test("if no constraint is typed, the former choice is kept", () => {
  const field = choiceOrText("Behaviour", { choice: "By constraint…", placeholder: "" }, () => {});
  const select = controlOf<HTMLSelectElement>(field, "select");
  const input = field.element.querySelector("input")!;
  field.offer([{ value: "wander", label: "wander" }]);
  field.show("wander");
  select.selectedIndex = 1;
  select.dispatchEvent(new Event("change"));
  expect(document.activeElement).toBe(input);
  leave(input, false);
  expect(select.value).toBe("wander");
  expect(input.hidden).toBe(true);
});
