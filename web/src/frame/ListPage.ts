// A page with one list that is requested repeatedly, so that it stays up to date.
import { needsToken } from "../api/JsonServer";
import { element, setText } from "../ui/element";
import { isMissing } from "./noBroker";
import { createTokenForm } from "../ui/tokenForm";
import type { Frame } from "./frame";
import { showFrame } from "./frame";

const POLL_MS = 3000;

// The content of the list at one time.
export interface Listing<Item> {
  note: string; // the source of the list
  items: Item[];
  more?: string; // a sentence below the list
}

// The texts and functions that a page with a list needs.
export interface ListSource<Item> {
  title: string; // title of the page
  label: string; // label of the list
  empty: string | Node; // shown if the list is empty
  missing?: string; // shown if the server does not know the list's address
  fetch(): Promise<Listing<Item>>;
  show(item: Item): HTMLElement; // makes a list item
  admit(token: string): void; // stores the token for all further requests
}

export class ListPage<Item> {
  private readonly wrong = element("p", { class: "field-error", role: "alert" });
  private readonly list: HTMLElement;
  private readonly more = element("p", { class: "hint" });
  private readonly token: HTMLElement;
  private frame: Frame | null = null;
  private shown = "";

  constructor(private readonly source: ListSource<Item>) {
    this.list = element("ul", { class: "frame-list", "aria-label": source.label });
    this.token = createTokenForm((token) => {
      source.admit(token);
      void this.load();
    });
  }

  show(page: HTMLElement): void {
    page.classList.add("list-page");
    this.wrong.hidden = this.token.hidden = true;
    this.more.hidden = true;
    const view = element("main", { class: "view" }, this.wrong, this.token, this.list, this.more);
    this.frame = showFrame(page, this.source.title, view);
  }

  async follow(): Promise<void> {
    await this.load();
    setTimeout(() => void this.follow(), POLL_MS);
  }

  // Waits for an action, and then updates the list.
  async after(action: Promise<void>): Promise<void> {
    try {
      await action;
    } catch (error) {
      this.complain(error);
      return;
    }
    await this.load();
  }

  async load(): Promise<void> {
    try {
      const listing = await this.source.fetch();
      this.wrong.hidden = this.token.hidden = true;
      const text = JSON.stringify(listing);
      // If nothing has changed, items are not replaced, because one of them may have the focus.
      if (text === this.shown) return;
      this.shown = text;
      this.take(listing);
    } catch (error) {
      this.complain(error);
    }
  }

  private complain(error: unknown): void {
    setText(this.wrong, (isMissing(error) && this.source.missing) || (error as Error).message);
    this.wrong.hidden = false;
    this.token.hidden = !needsToken(error);
  }

  private take({ note, items, more = "" }: Listing<Item>): void {
    if (this.frame) this.frame.note.textContent = note;
    this.list.replaceChildren(...items.map((item) => this.source.show(item)));
    if (items.length === 0) this.list.replaceChildren(element("li", { class: "hint" }, this.source.empty));
    this.more.textContent = more;
    this.more.hidden = more === "";
  }
}
