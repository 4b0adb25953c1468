// The common parts of all pages except the viewer: the bar with links to the simulation and to the
// other pages.
import "../style/page.css";
import "../style/panels.css";
import "../style/frame.css";
import { element } from "../ui/element";
import { BROKER, JOIN, RECORDINGS } from "../ui/pages";

export interface Frame {
  note: HTMLElement; // beside the title: the source of what the page shows
}

const PAGES = [JOIN, RECORDINGS, BROKER];

// `parts` are the page's own parts. Each has a place in the grid (style/page.css).
export function showFrame(page: HTMLElement, title: string, ...parts: HTMLElement[]): Frame {
  const note = element("code", { class: "frame-note dim" });
  const bar = element(
    "div",
    { class: "toolbar-start" },
    element("a", { class: "wordmark", href: "./", title: "The simulation" }, "GSV"),
    element("h1", {}, title),
    note,
  );
  page.classList.add("frame-page");
  page.append(element("header", { class: "toolbar" }, bar, pages(title)), ...parts);
  return { note };
}

function pages(current: string): HTMLElement {
  const links = PAGES.map(({ name, href }) =>
    element("a", { class: "button plain", href, "aria-current": name === current && "page" }, name),
  );
  const simulation = element("a", { class: "button plain", href: "./" }, "Simulation");
  return element("nav", { class: "frame-pages", "aria-label": "Pages" }, simulation, ...links);
}
