// The state of the simulation, its robots, the server and this page.
import type { ServerFigures } from "../../api/MetricsApi";

export type Health = "ok" | "warning" | "error";

// The diagnostic status of the simulation or of one robot.
export interface Diagnosis {
  name: string;
  health: Health;
  message: string;
  values: [key: string, value: string][];
}

export interface Diagnostics {
  simulation: Diagnosis | null;
  robots: readonly Diagnosis[];
  server: ServerFigures | null; // null if unknown
  dropped: number | null; // number of updates that were dropped because this page is too slow; null if unknown
}

export const NO_DIAGNOSTICS: Diagnostics = {
  simulation: null,
  robots: [],
  server: null,
  dropped: null,
};

// Returns the robots with problems, the worst first.
export function robotsWithProblems(robots: readonly Diagnosis[]): Diagnosis[] {
  const rank = ({ health }: Diagnosis) => (health === "error" ? 0 : 1);
  return robots.filter(({ health }) => health !== "ok").sort((a, b) => rank(a) - rank(b));
}
