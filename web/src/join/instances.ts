// The instances of GSV that the broker knows. Their data is untrusted: an address becomes a link
// only if it is a web address.
import type { JsonServer } from "../api/JsonServer";
import { listAt, numberOr, objectAt, textAt, textOr } from "../api/json";

export interface JoinableSimulation {
  name: string;
  phase: string;
  mode: string;
  time: number; // s, simulated
  robots: number;
  url: string | null; // address of its view; null if there is none
}

// A server of simulations that the broker knows.
export interface Instance {
  name: string;
  place: string; // host:pid
  isHere: boolean; // whether it serves this page
  url: string | null; // address of its viewer; null if it has none
  problem: string; // why its simulations are unknown; empty if they are known
  simulations: JoinableSimulation[];
}

// The time limit is long: the server queries the other instances, for some seconds each.
const TIMEOUT_MS = 30_000;

export async function fetchInstances(server: JsonServer): Promise<{ broker: string; instances: Instance[] }> {
  const answer = objectAt(await server.get("api/instances", TIMEOUT_MS), "instances");
  const instances = listAt(answer.instances, "instances").map(parseInstance);
  return { broker: textOr(answer.broker, ""), instances };
}

export function parseInstance(json: unknown): Instance {
  const instance = objectAt(json, "instance");
  const isHere = instance.is_here === true;
  const url = isHere ? "./" : webAddress(textOr(instance.viewer_url, ""));
  return {
    name: textOr(instance.name, ""),
    place: textOr(instance.place, ""),
    isHere,
    url,
    problem: textOr(instance.problem, ""),
    simulations: listAt(instance.simulations ?? [], "simulations").map((each) => {
      const simulation = objectAt(each, "simulation");
      const name = textAt(simulation.name, "simulation.name");
      return {
        name,
        phase: textOr(simulation.phase, ""),
        mode: textOr(simulation.mode, ""),
        time: numberOr(simulation.time_s, 0),
        robots: numberOr(simulation.robots, 0),
        url: url && `${url}?simulation=${encodeURIComponent(name)}`,
      };
    }),
  };
}

function webAddress(text: string): string | null {
  try {
    const { protocol, origin, pathname } = new URL(text);
    return protocol === "http:" || protocol === "https:" ? origin + pathname : null;
  } catch {
    return null;
  }
}
