// The page on which one joins a simulation: every instance that the broker knows, and what it runs.
import type { JsonServer } from "../api/JsonServer";
import { element } from "../ui/element";
import { count, formatTime } from "../ui/format";
import type { Instance, JoinableSimulation } from "./instances";
import { fetchInstances } from "./instances";

const POLL_MS = 3000;

export class JoinPage {
  private readonly address = element("code", { class: "broker-address dim" });
  private readonly wrong = element("p", { class: "field-error", role: "alert" });
  private readonly list = element("ul", { class: "instances", "aria-label": "Instances" });
  private shown = "";

  constructor(private readonly server: JsonServer) {}

  show(page: HTMLElement): void {
    page.classList.add("join-page");
    this.wrong.hidden = true;
    page.append(
      element(
        "header",
        { class: "toolbar" },
        element(
          "div",
          { class: "toolbar-start" },
          element("a", { class: "wordmark", href: "./", title: "The simulation" }, "GSV"),
          element("h1", {}, "Join"),
          this.address,
        ),
      ),
      element("main", { class: "view" }, this.wrong, this.list),
    );
  }

  // Asks again and again: simulations come and go.
  async follow(): Promise<void> {
    await this.load();
    setTimeout(() => void this.follow(), POLL_MS);
  }

  async load(): Promise<void> {
    try {
      const { broker, instances } = await fetchInstances(this.server);
      this.address.textContent = broker;
      this.wrong.hidden = true;
      const text = JSON.stringify(instances);
      // What has not changed keeps the focus that may be in it.
      if (text === this.shown) return;
      this.shown = text;
      this.list.replaceChildren(...instances.map(instanceItem));
      if (instances.length === 0) this.list.replaceChildren(element("li", { class: "hint" }, "No instance is offered."));
    } catch (error) {
      this.wrong.textContent = (error as Error).message;
      this.wrong.hidden = false;
    }
  }
}

function instanceItem(instance: Instance): HTMLElement {
  const { name, place, isHere, url, problem, simulations } = instance;
  const title = element("h2", {}, name || "gsv", element("span", { class: "dim" }, isHere ? " · this one" : ""));
  return element(
    "li",
    { class: "card instance", "data-place": place },
    title,
    element("p", { class: "dim" }, place),
    problem !== "" && element("p", { class: "field-error" }, problem),
    element("ul", {}, ...simulations.map(simulationItem)),
    problem === "" && simulations.length === 0 && element("p", { class: "dim" }, "It runs no simulation."),
    url === null && element("p", { class: "dim" }, "It was started without a viewer."),
    isHere && simulations.length === 0 && element("a", { class: "button", href: "./" }, "Create one"),
  );
}

function simulationItem({ name, phase, mode, time, robots, url }: JoinableSimulation): HTMLElement {
  const about = [phase, mode === "lockstep" ? "lockstep" : "", formatTime(time), count(robots, "robot")];
  const text = element("span", { class: "dim" }, about.filter(Boolean).join(" · "));
  const label = url === null ? element("span", {}, name) : element("a", { class: "button", href: url }, name);
  return element("li", { class: "joinable" }, label, text);
}
