// Requests the list of viewers, and which viewer has control.
import type { Credentials } from "./credentials";
import type { JsonServer } from "./JsonServer";
import { listAt, numberAt, numberOr, objectAt, textAt, textOr } from "./json";

// One viewer.
export interface Person {
  number: number;
  name: string;
  simulation: string; // the simulation that this viewer sees; empty if there is none
  holds: boolean; // whether this viewer has control of the simulation
  asks: number; // position of this viewer in the queue for control, from 1; 0 if not waiting
  // For the first viewer in the queue: time in s until it gets control, if the viewer who has
  // control does not answer. Other viewers do not use it.
  passesIn: number;
}

// All viewers of a server, and which viewer is this page.
export interface People {
  viewers: Person[]; // all viewers of the server
  you: number; // number of this page's viewer; 0 if it is not in the list
}

export class ViewersApi {
  constructor(
    private readonly server: JsonServer,
    private readonly credentials: Credentials,
  ) {}

  // `simulation` is the simulation that this page shows; empty if there is none.
  async enter(name: string, simulation: string): Promise<void> {
    const answer = objectAt(await this.server.post("api/viewers", { name, simulation }), "viewer");
    this.credentials.viewer = textAt(answer.key, "viewer.key");
  }

  async turn(simulation: string): Promise<People> {
    return parsePeople(await this.server.post("api/viewers/me", { simulation }));
  }

  async people(): Promise<People> {
    return parsePeople(await this.server.get("api/viewers"));
  }

  async rename(name: string): Promise<People> {
    return parsePeople(await this.server.post("api/viewers/me", { name }));
  }

  async want(wants: boolean): Promise<People> {
    return parsePeople(await this.server.post("api/viewers/me/control", { wants }));
  }

  async answer(grants: boolean): Promise<People> {
    return parsePeople(await this.server.post("api/viewers/me/answer", { grants }));
  }

  // Used while the page closes, so nobody waits for the answer.
  leave(): void {
    if (this.credentials.viewer === "") return;
    const url = this.server.url("api/viewers/me");
    void fetch(url, { method: "DELETE", keepalive: true, headers: this.credentials.headers }).catch(() => {});
    this.credentials.viewer = "";
  }
}

export function parsePeople(json: unknown): People {
  const people = objectAt(json, "viewers");
  return { viewers: listAt(people.viewers, "viewers").map(parsePerson), you: numberOr(people.you, 0) };
}

function parsePerson(json: unknown): Person {
  const viewer = objectAt(json, "viewer");
  return {
    number: numberAt(viewer.number, "viewer.number"),
    name: textAt(viewer.name, "viewer.name"),
    simulation: textOr(viewer.simulation, ""),
    holds: viewer.holds_control === true,
    asks: numberOr(viewer.asks, 0),
    passesIn: numberOr(viewer.passes_in_s, 0),
  };
}
