// A list of names and values under a heading.
import { element, setText } from "./element";

// A value without a name uses the whole line.
export type Fact = [name: string, value: string, health?: string];

export interface Facts {
  element: HTMLElement;
  show(facts: readonly Fact[]): void;
}

// `otherwise` is shown if there are no facts.
export function createFacts(title: string, otherwise: string): Facts {
  const list = element("dl", { class: "facts-list" });
  const empty = element("p", { class: "dim" }, otherwise);
  list.hidden = true;
  const cells: { name: HTMLElement; value: HTMLElement }[] = [];
  return {
    element: element("div", { class: "facts" }, element("h2", {}, title), list, empty),
    show(facts) {
      empty.hidden = facts.length > 0;
      list.hidden = facts.length === 0;
      for (const { name, value } of cells.splice(facts.length)) [name, value].forEach((cell) => cell.remove());
      facts.forEach(([name, value, health = ""], i) => {
        if (!cells[i]) {
          cells[i] = { name: element("dt"), value: element("dd") };
          list.append(cells[i].name, cells[i].value);
        }
        // Unchanged entries are not replaced, because the user may have selected their text.
        setText(cells[i].name, name);
        setText(cells[i].value, value);
        if (cells[i].name.className !== health) cells[i].name.className = health;
      });
    },
  };
}
