// Labelled inputs of forms, each with a place for the server's error.
import { element, setText } from "./element";

export interface Field<Value> {
  element: HTMLElement;
  show(value: Value): void;
  // Shows an error; an empty text removes it.
  refuse(sentence: string): void;
}

let nextId = 1;

// A label, its control, and its error.
function labelled<Value>(
  label: string,
  control: HTMLInputElement | HTMLSelectElement,
  show: (value: Value) => void,
  ...more: HTMLElement[]
): Field<Value> {
  const id = `field-${nextId++}`;
  control.id = id;
  const wrong = element("p", { class: "field-error", id: `${id}-error`, role: "alert" });
  wrong.hidden = true;
  const place = element("div", { class: "field" }, element("label", { for: id }, label), control, ...more, wrong);
  return {
    element: place,
    show,
    refuse: (sentence) => {
      setText(wrong, sentence);
      wrong.hidden = sentence === "";
      control.setAttribute("aria-invalid", String(sentence !== ""));
      if (sentence) control.setAttribute("aria-describedby", wrong.id);
      else control.removeAttribute("aria-describedby");
    },
  };
}

// Calls `take` with the typed text when the user has finished typing. Until then, new values (from
// the server or from another field) are not shown, so that typed text is not lost.
function keepTyped(input: HTMLInputElement, take: () => void) {
  let isTyping = false;
  let latest = input.value;
  input.addEventListener("input", () => (isTyping = true));
  input.addEventListener("change", () => {
    isTyping = false;
    take();
  });
  // The user left the field without a change.
  input.addEventListener("blur", () => {
    isTyping = false;
    input.value = latest;
  });
  return {
    isTyping: () => isTyping,
    show: (text: string) => {
      latest = text;
      if (!isTyping) input.value = text;
    },
  };
}

export function textField(label: string, placeholder: string, take: (text: string) => void): Field<string> {
  const input = element("input", { type: "text", placeholder, spellcheck: "false", autocomplete: "off" });
  const { show } = keepTyped(input, () => take(input.value.trim()));
  return labelled(label, input, show);
}

// A number field. An empty field means `otherwise`. `digits` is the number of digits after the
// decimal point.
export function numberField(
  label: string,
  otherwise: number | null,
  take: (value: number | null) => void,
  { step = "any", least = "", digits = 6 } = {},
): Field<number | null> {
  const input = element("input", { type: "number", step, ...(least && { min: least }) });
  const { show } = keepTyped(input, () => take(input.value === "" ? otherwise : Number(input.value)));
  return labelled(label, input, (value) => show(value === null ? "" : String(Number(value.toFixed(digits)))));
}

export function checkField(label: string, take: (value: boolean) => void): Field<boolean> {
  const input = element("input", { type: "checkbox" });
  input.addEventListener("change", () => take(input.checked));
  const field = labelled<boolean>(label, input, (value) => (input.checked = value));
  field.element.classList.add("check-field");
  return field;
}

// A colour as RRGGBB.
export function colourField(label: string, take: (colour: string) => void): Field<string> {
  const input = element("input", { type: "color" });
  input.addEventListener("change", () => take(input.value.slice(1)));
  return labelled<string>(label, input, (value) => (input.value = `#${value}`));
}

export interface Option {
  value: string;
  label: string;
  group?: string; // heading above the option; options of one group must be adjacent
}

export interface ChoiceField extends Field<string> {
  offer(options: Option[]): void;
}

// A selection from a list. The options of the list may change.
export function choiceField(label: string, take: (value: string) => void): ChoiceField {
  const select = element("select", {});
  const replace = replaceOptions(select);
  let shown = "";
  select.addEventListener("change", () => take(select.value));
  const field = labelled<string>(label, select, (value) => {
    shown = value;
    select.value = value;
  });
  return {
    ...field,
    offer: (options) => {
      if (replace(options)) select.value = shown;
    },
  };
}

// Replaces the options only if they differ, because a list that is open closes when its options are
// replaced. Returns whether they differed.
function replaceOptions(select: HTMLSelectElement) {
  let offered = "";
  return (options: Option[]): boolean => {
    const described = JSON.stringify(options);
    if (described === offered) return false;
    offered = described;
    select.replaceChildren(...grouped(options));
    return true;
  };
}

function grouped(options: Option[]): HTMLElement[] {
  const children: HTMLElement[] = [];
  for (const { value, label, group } of options) {
    const last = children.at(-1);
    const choice = new Option(label, value);
    if (group === undefined) children.push(choice);
    else if (last instanceof HTMLOptGroupElement && last.label === group) last.append(choice);
    else children.push(element("optgroup", { label: group }, choice));
  }
  return children;
}

const OTHER = "\0other"; // no option has this value

// A selection from a list, or a typed text.
export function choiceOrText(
  label: string,
  other: { choice: string; placeholder: string },
  take: (value: string) => void,
): ChoiceField {
  const input = element("input", {
    type: "text",
    "aria-label": `${label}: ${other.choice}`,
    placeholder: other.placeholder,
    spellcheck: "false",
  });
  const select = element("select", {});
  const replace = replaceOptions(select);
  const field = labelled<string>(label, select, () => {}, input);
  const text = keepTyped(input, () => {
    isAsked = false;
    take(input.value.trim());
  });
  let isAsked = false; // true while the text field is shown and empty
  let values: string[] = [];
  let shown = "";
  input.hidden = true;
  select.addEventListener("change", () => {
    isAsked = select.value === OTHER;
    input.hidden = !isAsked;
    if (isAsked) input.focus();
    else take(select.value);
  });
  input.addEventListener("blur", () => {
    isAsked = false;
    show(shown);
  });
  const show = (value: string) => {
    shown = value;
    if (isAsked || text.isTyping()) return;
    const isKnown = values.includes(value);
    select.value = isKnown ? value : OTHER;
    text.show(isKnown ? "" : value);
    input.hidden = isKnown;
  };
  return {
    ...field,
    show,
    offer: (options) => {
      values = options.map(({ value }) => value);
      if (!replace([...options, { value: OTHER, label: other.choice }])) return;
      if (isAsked || text.isTyping()) select.value = OTHER;
      else show(shown);
    },
  };
}
