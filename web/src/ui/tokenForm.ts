// A field for the token, shown if the server requires one or rejects the present one.
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
