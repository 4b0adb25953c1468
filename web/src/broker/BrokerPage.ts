// The broker page. It shows service types and links. For the selected type, it shows the offers,
// and the user can try a constraint.
import { showFrame } from "../frame/frame";
import { NO_BROKER, isMissing } from "../frame/noBroker";
import { needsToken } from "../api/JsonServer";
import { element } from "../ui/element";
import { createTokenForm } from "../ui/tokenForm";
import type { BrokerApi, Link, ServiceType } from "./BrokerApi";
import { offerList } from "./OfferList";

export class BrokerPage {
  private address: HTMLElement | null = null;
  private readonly types = element("div", { class: "types" });
  private readonly links = element("ul", { class: "links" });
  private readonly heading = element("h2", {}, "Offers");
  private readonly declared = element("div", {});
  private readonly constraint = field("constraint", "battery > 0.5 and exist camera");
  private readonly preference = field("preference", "min load");
  private readonly answer = element("div", { class: "answer" });
  private type = "";
  private asked = 0;

  // `admit` stores the token for further requests.
  constructor(
    private readonly api: BrokerApi,
    private readonly admit: (token: string) => void,
  ) {}

  show(page: HTMLElement): void {
    page.classList.add("broker-page");
    const { note } = showFrame(
      page,
      "Broker",
      element(
        "nav",
        { class: "sidebar", "aria-label": "Service types and links" },
        element("h2", {}, "Service types"),
        this.types,
        element("h2", {}, "Links"),
        this.links,
      ),
      element("main", { class: "view" }, this.heading, this.declared, this.question(), this.answer),
    );
    this.address = note;
  }

  async load(): Promise<void> {
    void this.loadLinks();
    try {
      const { broker, types } = await this.api.types();
      if (this.address) this.address.textContent = broker;
      this.types.replaceChildren(...types.map((type) => this.typeButton(type)));
      if (types.length === 0) this.types.replaceChildren(hint("No service types yet. Add one with `gsv types add`, or start a program that offers a service."));
      this.answer.replaceChildren();
      if (types[0]) await this.choose(types[0]);
    } catch (error) {
      this.complain(error);
    }
  }

  private question(): HTMLElement {
    const form = element(
      "form",
      { class: "question" },
      element("label", {}, element("span", {}, "Constraint"), this.constraint),
      element("label", {}, element("span", {}, "Preference"), this.preference),
      element("button", { class: "button primary", type: "submit" }, "Find"),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.find();
    });
    return form;
  }

  private typeButton(type: ServiceType): HTMLElement {
    const button = element(
      "button",
      { class: "robot type", type: "button", "aria-pressed": "false", "data-type": type.name },
      element("span", { class: "robot-name" }, type.name),
      element("span", { class: "robot-behaviour" }, type.superTypes.map((name) => `: ${name}`).join(" ")),
      type.masked && element("span", { class: "number" }, "masked"),
    );
    button.addEventListener("click", () => void this.choose(type));
    return button;
  }

  private async choose(type: ServiceType): Promise<void> {
    this.type = type.name;
    for (const button of this.types.querySelectorAll("button")) {
      button.setAttribute("aria-pressed", String(button.dataset.type === type.name));
    }
    this.heading.textContent = type.name;
    this.declared.replaceChildren(declaration(type));
    // Removes the shown offers, because they belong to the previously selected type.
    this.answer.replaceChildren();
    await this.find();
  }

  // Requests the offers. Answers to earlier requests are ignored.
  private async find(): Promise<void> {
    const turn = ++this.asked;
    const constraint = this.constraint.value.trim();
    try {
      const answer = await this.api.offers({
        type: this.type,
        constraint,
        preference: this.preference.value.trim(),
      });
      if (turn === this.asked) this.answer.replaceChildren(...offerList(answer, constraint));
    } catch (error) {
      if (turn === this.asked) this.complain(error);
    }
  }

  private async loadLinks(): Promise<void> {
    try {
      const links = await this.api.links();
      this.links.replaceChildren(...links.map(linkRow));
      if (links.length === 0) this.links.replaceChildren(element("li", {}, hint("None.")));
    } catch (error) {
      this.links.replaceChildren(element("li", {}, hint(isMissing(error) ? "None." : (error as Error).message)));
    }
  }

  private complain(error: unknown): void {
    if (isMissing(error)) return this.answer.replaceChildren(hint(NO_BROKER));
    const sentence = element("p", { class: "problem", role: "alert" }, (error as Error).message);
    this.answer.replaceChildren(sentence, ...(needsToken(error) ? [this.tokenForm()] : []));
  }

  private tokenForm(): HTMLElement {
    return createTokenForm((token) => {
      this.admit(token);
      void this.load();
    });
  }
}

function field(name: string, placeholder: string): HTMLInputElement {
  return element("input", { name, placeholder, spellcheck: "false", autocomplete: "off", autocapitalize: "off" });
}

function hint(text: string): HTMLElement {
  return element("p", { class: "hint" }, text);
}

function declaration({ interfaceName, properties }: ServiceType): HTMLElement {
  return element(
    "details",
    { class: "declared" },
    element("summary", {}, `${properties.length} declared properties`),
    interfaceName !== "" && element("p", { class: "dim" }, element("code", {}, interfaceName)),
    element(
      "dl",
      { class: "properties" },
      ...properties.flatMap(({ name, type, mandatory, readonly }) => [
        element("dt", {}, name),
        element("dd", {}, `${type}${mandatory ? ", mandatory" : ""}${readonly ? ", read-only" : ""}`),
      ]),
    ),
  );
}

function linkRow({ name, address, rules, answers }: Link): HTMLElement {
  return element(
    "li",
    { class: "link", "data-answers": String(answers) },
    element("span", { class: "dot", "data-phase": answers ? "running" : "dead", "aria-hidden": "true" }),
    element("span", { class: "robot-name" }, name),
    element("span", { class: "robot-behaviour" }, answers ? address : `${address} does not respond`),
    element("span", { class: "robot-behaviour" }, rules),
  );
}
