// Shows the key of each command in tooltips and in aria-keyshortcuts: the key that the user has
// assigned, else the default key.
import type { ChangedKeys } from "../state/shortcuts";
import { keyOf } from "../state/shortcuts";

export function showKeys(root: ParentNode, changed: ChangedKeys): void {
  for (const button of root.querySelectorAll<HTMLElement>("[data-key]")) {
    const { key: original = "", title = "" } = button.dataset;
    if ([...original].length !== 1) continue;
    const key = keyOf(original, changed).toUpperCase();
    const shown = button.querySelector("kbd");
    if (shown) shown.textContent = key;
    else button.title = `${title} (${key})`;
    button.setAttribute("aria-keyshortcuts", key);
  }
}
