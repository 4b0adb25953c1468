// The names in the view as a text for screen readers. It is not visible. The list of robots contains
// all robots.

const MAX_NAMES = 40;
const PAUSE_MS = 1000; // minimum time between two changes of the text

export class SpokenNames {
  readonly element = document.createElement("p");
  private names: readonly string[] = [];
  private waiting: ReturnType<typeof setTimeout> | undefined;

  constructor() {
    this.element.className = "spoken-names";
  }

  // Sets the labels, the most important one first.
  set(labels: readonly { name: string }[]): void {
    if (labels.length === this.names.length && labels.every(({ name }, i) => name === this.names[i])) return;
    this.names = labels.map(({ name }) => name);
    this.waiting ??= setTimeout(() => this.write(), PAUSE_MS);
  }

  private write(): void {
    this.waiting = undefined;
    const { names } = this;
    const more = names.length > MAX_NAMES ? ` and ${names.length - MAX_NAMES} more` : "";
    const text = names.length > 0 ? `Names in the view: ${names.slice(0, MAX_NAMES).join(", ")}${more}` : "";
    if (this.element.textContent !== text) this.element.textContent = text;
  }
}
