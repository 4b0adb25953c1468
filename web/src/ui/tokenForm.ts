// Where a server takes a token that was not shown, or not the right one: a field for it.
import { element } from "./element";

export function createTokenForm(enter: (token: string) => void): HTMLFormElement {
  const field = element("input", {
    type: "password",
    "aria-label": "Token",
    autocomplete: "off",
    spellcheck: "false",
    class: "token-field",
  });
  const button = element("button", { class: "button primary", type: "submit" }, "Enter");
  const form = element("form", { class: "retry" }, field, button);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    enter(field.value.trim());
  });
  return form;
}
