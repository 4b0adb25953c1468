// The simulations of earlier servers that ended unexpectedly. A simulation is listed until a user
// dismisses it.
import { ApiError } from "../api/JsonServer";
import type { JsonServer } from "../api/JsonServer";
import { listAt, numberAt, objectAt, textAt, textOr } from "../api/json";

// A simulation whose server crashed.
export interface LostSimulation {
  number: number; // number of this report; a request to dismiss it contains the number
  name: string;
  sentence: string;
  replay: string; // name of its recording in the server's folder; empty if there is none
}

// Servers that keep no record of crashes, such as `gsv run`, have no such list.
export async function fetchLost(server: JsonServer): Promise<LostSimulation[]> {
  try {
    const answer = objectAt(await server.get("api/lost"), "lost");
    return listAt(answer.lost, "lost").map(parseLost);
  } catch (error) {
    if (error instanceof ApiError && error.httpStatus === 404) return [];
    throw error;
  }
}

function parseLost(json: unknown): LostSimulation {
  const lost = objectAt(json, "lost simulation");
  return {
    number: numberAt(lost.number, "lost.number"),
    name: textAt(lost.name, "lost.name"),
    sentence: textOr(lost.sentence, ""),
    replay: textOr(lost.replay, ""),
  };
}

export async function dismissLost(server: JsonServer, number: number): Promise<void> {
  await server.delete(`api/lost/${number}`);
}
