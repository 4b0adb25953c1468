// Builds elements of the page. Text is never interpreted as markup, so a name that contains markup
// is shown literally.

type Child = Node | string | null | false;
type Attributes = Record<string, string | boolean | ((event: never) => void)>;

// element("button", { class: "plain", title: "Close", onclick: close }, "×"): names that begin with
// "on" are listeners, all others are attributes. true means present, false absent.
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false) made.setAttribute(name, value);
  }
  made.append(...children.filter((child): child is Node | string => child !== null && child !== false));
  return made;
}

// Writes only if the text differs, because a new text removes the user's text selection.
export function setText(node: Node, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

// Writes only if the value differs, because setting it makes the browser compute the style again.
export function setAttribute(node: Element, name: string, value: string): void {
  if (node.getAttribute(name) !== value) node.setAttribute(name, value);
}
