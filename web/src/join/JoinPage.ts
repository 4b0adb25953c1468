// The page for joining a simulation: all servers (instances) that the broker knows, with their
// simulations, and simulations that ended by a crash.
import type { JsonServer } from "../api/JsonServer";
import { NO_BROKER } from "../frame/noBroker";
import { ListPage } from "../frame/ListPage";
import { element } from "../ui/element";
import { replayUrl } from "../recordings/recordings";
import { count, formatTime } from "../ui/format";
import type { Instance, JoinableSimulation } from "./instances";
import { fetchInstances } from "./instances";
import type { LostSimulation } from "./lost";
import { dismissLost, fetchLost } from "./lost";

export function createJoinPage(
  server: JsonServer,
  admit: (token: string) => void,
): ListPage<Instance | LostSimulation> {
  const dismiss = (number: number) => void page.after(dismissLost(server, number));
  const page: ListPage<Instance | LostSimulation> = new ListPage({
    admit,
    title: "Join",
    label: "Instances",
    missing: NO_BROKER,
    empty: "No instances found. Start one with `gsv run` or `gsv serve`.",
    fetch: async () => {
      const [{ broker, instances }, lost] = await Promise.all([fetchInstances(server), fetchLost(server)]);
      return { note: broker, items: [...lost, ...instances] };
    },
    show: (item) => ("sentence" in item ? lostItem(item, dismiss) : instanceItem(item)),
  });
  return page;
}

function lostItem({ number, name, sentence, replay }: LostSimulation, dismiss: (number: number) => void): HTMLElement {
  const seen = element("button", { type: "button", class: "button", "aria-label": `Dismiss ${name}` }, "Dismiss");
  seen.addEventListener("click", () => dismiss(number));
  return element(
    "li",
    { class: "card frame-item lost" },
    element("h2", {}, `${name} ended because its server crashed`),
    element("p", {}, sentence),
    element(
      "div",
      { class: "frame-row" },
      replay !== "" && element("a", { class: "button", href: replayUrl(replay), "aria-label": `Replay ${replay}` }, "Replay"),
      seen,
    ),
  );
}

function instanceItem(instance: Instance): HTMLElement {
  const { name, place, isHere, url, problem, simulations } = instance;
  const title = element("h2", {}, name || "gsv", element("span", { class: "dim" }, isHere ? " · this one" : ""));
  return element(
    "li",
    { class: "card frame-item instance", "data-place": place },
    title,
    element("p", { class: "dim" }, place),
    problem !== "" && element("p", { class: "field-error" }, problem),
    element("ul", {}, ...simulations.map(simulationItem)),
    problem === "" && simulations.length === 0 && element("p", { class: "dim" }, "No simulation is running."),
    url === null && element("p", { class: "dim" }, "This instance runs without a viewer. Start it without --headless."),
    isHere && simulations.length === 0 && element("a", { class: "button", href: "./" }, "Create simulation"),
  );
}

function simulationItem({ name, phase, mode, time, robots, url }: JoinableSimulation): HTMLElement {
  const about = [phase, mode === "lockstep" ? "lockstep" : "", formatTime(time), count(robots, "robot")];
  const text = element("span", { class: "dim" }, about.filter(Boolean).join(" · "));
  const label = url === null ? element("span", {}, name) : element("a", { class: "button", href: url }, name);
  return element("li", { class: "frame-row joinable" }, label, text);
}
