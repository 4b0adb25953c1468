// The panels, in the order of their buttons.
import type { Panel } from "./contract/Panel";

export const PANELS: readonly Panel[] = [
  {
    id: "plots",
    title: "Plots",
    hint: "Plots against simulated time",
    picture: "plot",
    key: "P",
    isAvailable: () => true,
    load: () => import("./plots/PlotPanel"),
  },
  {
    id: "log",
    title: "Log",
    hint: "Log of the simulation",
    picture: "log",
    key: "G",
    isAvailable: () => true,
    load: () => import("./log/LogPanel"),
  },
  {
    id: "expectations",
    title: "Expectations",
    hint: "Expectations of the scenario: verdicts and margins",
    picture: "check",
    key: "E",
    isAvailable: ({ expectations }) => expectations.length > 0,
    load: () => import("./expectations/ExpectationsPanel"),
  },
  {
    id: "diagnostics",
    title: "Diagnostics",
    hint: "Diagnostics: failed robots and server health",
    picture: "pulse",
    key: "H",
    isAvailable: () => true,
    load: () => import("./diagnostics/DiagnosticsPanel"),
  },
  {
    id: "status",
    title: "Status",
    hint: "Status of the simulation, its robots and the server",
    picture: "status",
    key: "I",
    isAvailable: () => true,
    load: () => import("./status/StatusPanel"),
  },
  {
    id: "commands",
    title: "Commands",
    hint: "Commands of the simulation",
    picture: "gauge",
    isAvailable: ({ replay }) => replay === null,
    load: () => import("./commands/CommandsPanel"),
  },
];
