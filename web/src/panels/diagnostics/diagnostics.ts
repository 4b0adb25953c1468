// The state of the simulation, its robots, the server and this page.
import type { ServerFigures } from "../../api/MetricsApi";

export type Health = "ok" | "warning" | "error";

export interface Diagnosis {
  name: string;
  health: Health;
  message: string;
  values: [key: string, value: string][];
}

export interface Diagnostics {
  simulation: Diagnosis | null;
  robots: readonly Diagnosis[];
  server: ServerFigures | null; // null: not known
  dropped: number | null; // updates that this page was too slow for; null: not known
}

export const NO_DIAGNOSTICS: Diagnostics = {
  simulation: null,
  robots: [],
  server: null,
  dropped: null,
};

// The robots with problems, the worst first.
export function unwell(robots: readonly Diagnosis[]): Diagnosis[] {
  const rank = ({ health }: Diagnosis) => (health === "error" ? 0 : 1);
  return robots.filter(({ health }) => health !== "ok").sort((a, b) => rank(a) - rank(b));
}
