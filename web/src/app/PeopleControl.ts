// Says this viewer's name, keeps asking who else is there and who holds control, and asks for it.
import { ApiError } from "../api/JsonServer";
import type { People, ViewersApi } from "../api/ViewersApi";
import { NO_PEOPLE, personOf } from "../state/people";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { notify } from "./notices";

const POLL_MS = 1500;
const NAME = "gsv-name";

export class PeopleControl {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isThere = false;

  constructor(
    private readonly store: Store<State>,
    private readonly api: ViewersApi,
    private readonly storage: Pick<Storage, "getItem" | "setItem"> | null,
  ) {}

  start(window: Window): void {
    window.addEventListener("pagehide", () => {
      this.isThere = false;
      this.api.leave();
    });
    void this.follow();
  }

  get name(): string {
    return this.storage?.getItem(NAME) ?? "";
  }

  rename(name: string): Promise<void> {
    this.storage?.setItem(NAME, name.trim());
    return this.ask(() => this.api.rename(name));
  }

  // Asks for control, or lets go of it.
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
    this.timer = setTimeout(() => void this.follow(), POLL_MS);
  }

  // After a server's restart, or an absence, the name is said again.
  async load(): Promise<void> {
    try {
      if (!this.isThere) await this.api.enter(this.name);
      this.isThere = true;
      const people = await this.api.people();
      this.isThere = people.you !== 0;
      this.take(people);
    } catch (error) {
      // The connection tells of itself. A server that knows no viewers lets all act.
      if (error instanceof ApiError) this.store.set({ people: NO_PEOPLE });
    }
  }

  private take(people: People): void {
    const before = this.store.get().people;
    this.store.set({ people });
    if (before.holder === people.holder) return;
    const holder = personOf(people, people.holder);
    if (people.holder === people.you && holder) notify(this.store, "note", "You hold control.");
    else if (before.holder === before.you && before.you !== 0 && holder) {
      notify(this.store, "note", `${holder.name} holds control now.`);
    }
  }
}

