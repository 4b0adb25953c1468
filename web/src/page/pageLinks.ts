// Makes links to the other pages. A page without content gets no link.
import type { App } from "../app/App";
import type { State } from "../state/State";
import { element } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon } from "../ui/icons";
import type { Page } from "../ui/pages";
import { BROKER, JOIN, RECORDINGS } from "../ui/pages";

interface Link extends Page {
  picture: IconName;
  label: string;
  isOffered: (state: State) => boolean;
}

const LINKS: Link[] = [
  { ...JOIN, picture: "join", label: "Join another simulation", isOffered: isLive },
  { ...RECORDINGS, picture: "recordings", label: "Recordings", isOffered: ({ abilities }) => abilities.recordings },
  { ...BROKER, picture: "broker", label: "Broker", isOffered: isLive },
];

// Whether the page shows a simulation, and not the replay of a recording, which has no broker.
function isLive({ replay }: State): boolean {
  return replay === null;
}

// The pages that have content at present.
export function offeredPages(state: State): { label: string; href: string }[] {
  return LINKS.filter(({ isOffered }) => isOffered(state));
}

// The links as icons in the toolbar.
export function pageLinks(app: App): HTMLElement[] {
  return LINKS.map(({ picture, href, name, label, isOffered }) => {
    const word = element("span", { class: "word", "aria-hidden": "true" }, name);
    const link = element("a", { class: "button plain worded", href, "aria-label": label, title: label }, icon(picture), word);
    return whileOffered(app, link, isOffered);
  });
}

// The links by name, for the help sheet and for narrow toolbars.
export function pageNames(app: App): HTMLElement {
  const links = LINKS.map(({ href, name, isOffered }) =>
    whileOffered(app, element("a", { class: "button plain", href }, name), isOffered),
  );
  const help = element("button", { class: "button plain", type: "button", onclick: () => app.openHelp(true) }, "Help");
  return element("div", { class: "sidebar-pages" }, ...links, help);
}

function whileOffered(app: App, link: HTMLElement, isOffered: (state: State) => boolean): HTMLElement {
  app.store.watch(isOffered, (offered) => (link.hidden = !offered));
  return link;
}
