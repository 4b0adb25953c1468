// Reports this viewer's name and simulation to the server, receives the list of viewers and
// control, and requests control.
import { ApiError } from "../api/JsonServer";
import type { People, ViewersApi } from "../api/ViewersApi";
import { parsePeople } from "../api/ViewersApi";
import { holderOf, NO_PEOPLE, youOf } from "../state/people";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { notify } from "./notices";
import type { Session } from "./Session";

// The stream reports changes at once. The server forgets this page if it does not report
// repeatedly.
const TOPIC = "/gsv/viewers";
const PRESENCE_MS = 3000;
const NAME = "gsv-name";

export class PeopleControl {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isThere = false;
  private saidSimulation = "";
  private endOfTopic = () => {};

  constructor(
    private readonly store: Store<State>,
    private readonly session: Pick<Session, "subscribe">,
    private readonly api: ViewersApi,
    private readonly storage: Pick<Storage, "getItem" | "setItem"> | null,
  ) {}

  start(window: Window): void {
    window.addEventListener("pagehide", () => {
      this.isThere = false;
      this.api.leave();
    });
    this.store.watch(
      ({ simulation, scene }) => ({ simulation, isThere: scene !== null }),
      ({ isThere }) => {
        this.endOfTopic();
        this.endOfTopic = isThere ? this.session.subscribe<{ data: string }>(TOPIC, ({ data }) => this.hear(data)) : () => {};
        if (this.isThere) void this.load();
      },
      shallowEqual,
    );
    void this.follow();
  }

  get name(): string {
    return this.storage?.getItem(NAME) ?? "";
  }

  rename(name: string): Promise<void> {
    this.storage?.setItem(NAME, name.trim());
    return this.ask(() => this.api.rename(name));
  }

  // Requests or releases control.
  want(wants: boolean): Promise<void> {
    return this.ask(() => this.api.want(wants));
  }

  answer(grants: boolean): Promise<void> {
    return this.ask(() => this.api.answer(grants));
  }

  private async ask(question: () => Promise<People>): Promise<void> {
    try {
      this.take(await question());
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  private async follow(): Promise<void> {
    await this.load();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.follow(), PRESENCE_MS);
  }

  // Sends the name again if the server has restarted, or if the page was offline for some time.
  async load(): Promise<void> {
    const simulation = this.store.get().simulation ?? "";
    try {
      // The server drops viewers that do not report for some seconds.
      let people = this.isThere ? await this.api.people() : NO_PEOPLE;
      if (people.you === 0) {
        await this.api.enter(this.name, simulation);
        people = await this.api.people();
      } else if (simulation !== this.saidSimulation) {
        people = await this.api.turn(simulation);
      }
      this.saidSimulation = simulation;
      this.isThere = people.you !== 0;
      this.take(people);
    } catch (error) {
      // A failure of the connection is ignored, because it is reported elsewhere. A server without
      // a list of viewers allows all actions.
      if (!(error instanceof ApiError)) return;
      this.isThere = false;
      this.store.set({ people: NO_PEOPLE });
    }
  }

  // Takes the list of viewers from a message. All viewers get the same message, so it does not
  // contain the number of this page's viewer.
  private hear(text: string): void {
    const { you } = this.store.get().people;
    if (you !== 0) this.take({ ...parsePeople(JSON.parse(text)), you });
  }

  private take(people: People): void {
    const before = this.store.get().people;
    this.store.set({ people });
    const [now, then] = [holderOf(people), holderOf(before)];
    if (now === null || now.number === then?.number) return;
    if (now.number === people.you) notify(this.store, "note", "You have control.");
    else if (youOf(before)?.holds && youOf(people)?.simulation === youOf(before)?.simulation) {
      notify(this.store, "note", `${now.name} has control now.`);
    }
  }
}
