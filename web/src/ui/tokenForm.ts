// A field for the token. It is shown if the server requires a token or rejects the present token.
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
