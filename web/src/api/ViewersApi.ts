// Who else is watching, and who of them holds control.
import type { Credentials } from "./credentials";
import type { JsonServer } from "./JsonServer";
import { listAt, numberAt, numberOr, objectAt, textAt } from "./json";

export interface Person {
  number: number;
  name: string;
}

export interface People {
  viewers: Person[];
  you: number; // 0: none of them
  holder: number; // 0: nobody, so that all may act
  asking: number[]; // for control, the first one first
  passesIn: number; // s, until the first of them gets it without an answer
}

export class ViewersApi {
  constructor(
    private readonly server: JsonServer,
    private readonly credentials: Credentials,
  ) {}

  async enter(name: string): Promise<void> {
    const answer = objectAt(await this.server.post("api/viewers", { name }), "viewer");
    this.credentials.viewer = textAt(answer.key, "viewer.key");
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

  // While the page closes: nobody waits for the answer.
  leave(): void {
    if (this.credentials.viewer === "") return;
    const url = this.server.url("api/viewers/me");
    void fetch(url, { method: "DELETE", keepalive: true, headers: this.credentials.headers }).catch(() => {});
    this.credentials.viewer = "";
  }
}

export function parsePeople(json: unknown): People {
  const people = objectAt(json, "viewers");
  return {
    viewers: listAt(people.viewers, "viewers").map((each) => {
      const viewer = objectAt(each, "viewer");
      return { number: numberAt(viewer.number, "viewer.number"), name: textAt(viewer.name, "viewer.name") };
    }),
    you: numberOr(people.you, 0),
    holder: numberOr(people.holder, 0),
    asking: listAt(people.asking ?? [], "asking").map((each) => numberOr(each, 0)),
    passesIn: numberOr(people.passes_in_s, 0),
  };
}
