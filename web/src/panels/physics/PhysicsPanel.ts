// The panel Physics: gravity, step and speed, the time that each part of the steps takes, and the
// behaviours that delay the steps.
import type { SimulationStatus } from "../../api/status";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { Fact } from "../../ui/facts";
import { createFacts } from "../../ui/facts";
import { formatFactor } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import type { StepCost, StepCostsMessage } from "./stepCosts";
import { PARTS, StepCosts, busyTime, paceSentence } from "./stepCosts";

type Ports = Pick<PanelPorts, "state" | "topics" | "server" | "robots">;

const TOPIC = "/gsv/step_costs";
const POLL_MS = 2000;
const MAX_STEPS = 32;
const MAX_HOLD_UPS = 20;

interface World {
  gravity: number | null; // along z, m/s²; null if the server does not report it
  step: number | null; // s
}

export function mount({ state, topics, server, robots }: Ports): MountedPanel {
  const costs = new StepCosts();
  let world: World = { gravity: null, step: null };
  const sentence = element("p", { class: "physics-why", role: "status" });
  const facts = createFacts("World", "No simulation.");
  const parts = new Bars();
  const steps = new Waterfall();
  const holdUps = holdUpTable((robot) => robots.select(robot));

  const show = () => {
    const { status, scene } = state.get();
    if (!status) return;
    setText(sentence, paceSentence(status, costs));
    facts.show(factsOf(status, world, scene?.bodies.length ?? 0));
    parts.show(costs);
    steps.show(costs.longest(MAX_STEPS));
    holdUps.show(costs);
  };
  // If the server does not answer, for example because it does not have this parameter, the value
  // stays unknown.
  const ask = async (key: keyof World, parameter: string) => {
    const value = await server.parameter(parameter).catch(() => null);
    if (typeof value !== "number") return;
    world = { ...world, [key]: value };
    show();
  };
  const load = () => {
    void ask("gravity", "/gsv/gravity_z_m_s2");
    void ask("step", "/gsv/step_size_s");
  };
  const whileOpen = () => {
    const timer = setInterval(load, POLL_MS);
    const ends = [
      topics.subscribe<StepCostsMessage>(TOPIC, (message) => {
        costs.add(message);
        show();
      }),
      state.watch(({ status }) => status, show),
      state.watch(
        ({ simulation, status }) => ({ simulation, isRunning: status?.phase === "running" }),
        () => {
          costs.clear();
          show();
        },
        shallowEqual,
      ),
    ];
    load();
    return () => {
      clearInterval(timer);
      ends.forEach((end) => end());
    };
  };
  const body = element(
    "div",
    { class: "physics-body", tabindex: "0", role: "region", "aria-label": "Steps" },
    sentence,
    element("div", { class: "physics-columns" }, facts.element, parts.element, holdUps.element, steps.element),
  );
  return { body, whileOpen };
}

function factsOf(status: SimulationStatus, { gravity, step }: World, bodies: number): Fact[] {
  const isRealTime = status.mode === "real_time";
  const speed = isRealTime ? `${formatFactor(status.realTimeFactor)} (target ${formatFactor(status.targetFactor)})` : formatFactor(status.realTimeFactor);
  const facts: Fact[] = [
    ["mode", isRealTime ? "real time" : "lockstep"],
    ["real-time factor", speed],
    ["bodies", bodies.toLocaleString("en")],
    ["late steps", status.lateSteps.toLocaleString("en")],
  ];
  if (step !== null) facts.unshift(["step", milliseconds(step)]);
  if (gravity !== null) facts.unshift(["gravity", `${gravity.toFixed(2)} m/s² along z`]);
  return facts;
}

function milliseconds(seconds: number): string {
  const ms = 1000 * seconds;
  return `${ms >= 100 ? ms.toFixed(0) : ms >= 1 ? ms.toFixed(2) : ms.toFixed(3)} ms`;
}

// Bars of the mean time that each part of a step takes.
class Bars {
  private readonly rows = PARTS.map(({ key, label, hint }) => {
    const bar = element("span", { class: `cost-bar ${key}` });
    const value = element("td", { class: "number" }, "–");
    const name = element("th", { scope: "row", title: hint }, label);
    return { key, bar, value, element: element("tr", {}, name, element("td", { class: "cost-cell" }, bar), value) };
  });
  readonly element = element(
    "div",
    { class: "facts" },
    element("h2", {}, "Mean cost of a step"),
    element("table", { class: "cost-table" }, element("tbody", {}, ...this.rows.map((row) => row.element))),
  );

  show(costs: StepCosts): void {
    const { steps } = costs;
    const all = PARTS.reduce((sum, { key }) => sum + costs.of(key), 0);
    for (const { key, bar, value } of this.rows) {
      bar.style.width = all > 0 ? `${(100 * costs.of(key)) / all}%` : "0";
      setText(value, steps > 0 ? milliseconds(costs.of(key) / steps) : "–");
    }
  }
}

// The longest steps. Each step is a line, with a bar for each part.
class Waterfall {
  private readonly lines: { step: HTMLElement; bar: HTMLElement; who: HTMLElement; total: HTMLElement; element: HTMLElement }[] = [];
  private readonly rows = element("tbody");
  private readonly empty = element("p", { class: "dim" }, "No steps measured yet.");
  private readonly table = element(
    "table",
    { class: "cost-table waterfall" },
    element(
      "thead",
      {},
      element("tr", {}, ...["Step", "Parts", "Delayed by", "Time"].map((name) => element("th", { scope: "col" }, name))),
    ),
    this.rows,
  );
  readonly element = element("div", { class: "facts" }, element("h2", {}, "Longest steps of the last seconds"), this.empty, this.table);

  show(costs: readonly StepCost[]): void {
    this.empty.hidden = costs.length > 0;
    this.table.hidden = costs.length === 0;
    const longest = Math.max(...costs.map(busyTime), 1e-9);
    for (const { element: row } of this.lines.splice(costs.length)) row.remove();
    costs.forEach((cost, i) => {
      const line = this.lines[i] ?? this.addLine();
      setText(line.step, cost.step.toLocaleString("en"));
      setText(line.who, cost.held_up_by || "–");
      setText(line.total, milliseconds(busyTime(cost)));
      PARTS.forEach(({ key, label }, part) => {
        const piece = line.bar.children[part] as HTMLElement;
        piece.style.width = key === "idle_s" ? "0" : `${(100 * cost[key]) / longest}%`;
        piece.title = `${label}: ${milliseconds(cost[key])}`;
      });
    });
  }

  private addLine() {
    const [step, who, total] = [element("td", { class: "number" }), element("td"), element("td", { class: "number" })];
    const bar = element("div", { class: "cost-pieces" }, ...PARTS.map(({ key }) => element("span", { class: `cost-bar ${key}` })));
    const line = { step, bar, who, total, element: element("tr", {}, step, element("td", { class: "cost-cell" }, bar), who, total) };
    this.rows.append(line.element);
    this.lines.push(line);
    return line;
  }
}

function holdUpTable(select: (robot: string) => void) {
  const rows = element("tbody");
  const empty = element("p", { class: "dim" }, "No behaviour delays the steps.");
  const head = ["Robot", "Steps", "Mean", "Longest"].map((name) => element("th", { scope: "col" }, name));
  const table = element("table", { class: "panel-table" }, element("thead", {}, element("tr", {}, ...head)), rows);
  return {
    element: element("div", { class: "facts" }, element("h2", {}, "Behaviours that delay the steps"), empty, table),
    show(costs: StepCosts) {
      const found = costs.holdUps.slice(0, MAX_HOLD_UPS);
      empty.hidden = found.length > 0;
      table.hidden = found.length === 0;
      rows.replaceChildren(
        ...found.map(({ robot, steps, total, longest }) => {
          const name = element("button", { class: "button plain", type: "button", onclick: () => select(robot) }, robot);
          const cells = [steps.toLocaleString("en"), milliseconds(total / steps), milliseconds(longest)];
          return element("tr", {}, element("td", {}, name), ...cells.map((text) => element("td", { class: "number" }, text)));
        }),
      );
    },
  };
}
