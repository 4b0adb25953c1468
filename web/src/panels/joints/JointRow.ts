// One joint: its position between its limits. A slider and a number field command the joint.
import { NewestOnly } from "../../api/NewestOnly";
import type { Joint } from "../../api/joints";
import { element, setAttribute, setText } from "../../ui/element";
import { formatNumber } from "../../ui/format";

const STEPS = 400; // number of steps of the slider
const USUAL_VELOCITY = 2; // used if the joint has no velocity limit, rad/s or m/s
// After the user has set a value, the row shows this value at least for 600 ms. The server reports
// it with a delay. Without this time, the row would show the old value in between.
const HELD_MS = 600;

interface Actions {
  command(joint: string, kind: "position" | "velocity", value: number): Promise<void>;
  problem(sentence: string): void;
}

interface How {
  isRefused: boolean; // whether commands are not possible now
  isPaused: boolean; // whether commands wait until the simulation runs
  inDegrees: boolean;
}

export class JointRow {
  readonly element: HTMLElement;
  private readonly state = element("span", { class: "joint-state number" });
  private readonly limits = element("span", { class: "dim number" });
  private readonly refusal = element("p", { class: "dim" });
  private readonly later = element("p", { class: "joint-later", role: "status" });
  private readonly slider: HTMLInputElement;
  private readonly field: HTMLInputElement;
  private readonly wishes: NewestOnly<number>;
  private readonly kind: "position" | "velocity";
  private inDegrees = false;
  private heldUntil = 0; // ms
  private waiting: number | null = null; // value that the user has set; null after `heldUntil`

  constructor(joint: Joint, { command, problem }: Actions) {
    const hasLimits = Number.isFinite(joint.minimum) && Number.isFinite(joint.maximum);
    // A slider for the position needs limits. For a joint without limits, the slider sets the
    // velocity.
    this.kind = hasLimits ? "position" : "velocity";
    const [minimum, maximum] = this.rangeOf(joint);
    this.slider = element("input", {
      type: "range",
      min: String(minimum),
      max: String(maximum),
      step: String((maximum - minimum) / STEPS || 1),
      "aria-label": `${joint.name}: ${this.kind}`,
    });
    this.field = element("input", { type: "number", step: "any", "aria-label": `${joint.name}: ${this.kind} as a number` });
    this.wishes = new NewestOnly((value) => command(joint.name, this.kind, value), (sentence) => {
      this.forget();
      problem(sentence);
    });
    this.slider.addEventListener("input", () => this.send(Number(this.slider.value)));
    this.field.addEventListener("change", () => {
      if (this.field.value !== "") this.send(Math.min(maximum, Math.max(minimum, Number(this.field.value) / this.scale(joint.unit))));
    });
    this.slider.addEventListener("dblclick", () => this.kind === "velocity" && this.send(0));
    const name = element("span", { class: "joint-name", title: joint.name }, joint.name);
    const head = element("div", { class: "joint-head" }, name, element("span", { class: "dim" }, joint.kind), this.state);
    const stop = element("button", { class: "button small", type: "button", onclick: () => this.send(0) }, "Stop");
    stop.hidden = this.kind === "position";
    const controls = element("div", { class: "joint-controls" }, this.slider, this.field, stop);
    this.element = element("li", { "data-joint": joint.name }, head, controls, this.limits, this.later, this.refusal);
  }

  // Forgets a value that was not applied.
  forget(): void {
    this.waiting = null;
    this.heldUntil = 0;
  }

  show(joint: Joint, { isRefused, isPaused, inDegrees }: How): void {
    this.inDegrees = inDegrees;
    const scale = this.scale(joint.unit);
    const unit = inDegrees && joint.unit === "rad" ? "°" : joint.unit;
    const digits = unit === "°" ? 1 : 3;
    const text = (value: number) => `${formatNumber(value * scale, digits)} ${unit}`;
    setText(this.state, `${text(joint.position)}, ${text(joint.velocity)}/s`);
    setText(this.limits, limitsOf(joint, text));
    setText(this.refusal, joint.refusal);
    this.refusal.hidden = joint.refusal === "";
    const isOff = isRefused || joint.refusal !== "";
    this.slider.disabled = this.field.disabled = isOff;
    for (const button of this.element.querySelectorAll("button")) button.disabled = isOff;
    const commanded = joint.command?.kind === this.kind ? joint.command.value : this.kind === "position" ? joint.position : 0;
    if (isPaused && this.waiting !== null) this.heldUntil = performance.now() + HELD_MS;
    const isHeld = performance.now() < this.heldUntil || document.activeElement === this.field;
    if (!isHeld) this.waiting = null;
    const perSecond = this.kind === "velocity" ? "/s" : "";
    setText(this.later, isPaused && this.waiting !== null ? `${text(this.waiting)}${perSecond} is applied when the simulation resumes.` : "");
    this.later.hidden = this.later.textContent === "";
    if (!isHeld) this.showTarget(commanded, scale, digits);
    else if (this.waiting !== null && document.activeElement !== this.field) this.showTarget(this.waiting, scale, digits);
    setAttribute(this.slider, "aria-valuetext", `${text(Number(this.slider.value))}${perSecond}`);
  }

  private showTarget(value: number, scale: number, digits: number): void {
    if (document.activeElement !== this.slider || Math.abs(Number(this.slider.value) - value) > 1e-9) this.slider.value = String(value);
    this.field.value = formatNumber(value * scale, digits);
  }

  private send(value: number): void {
    this.heldUntil = performance.now() + HELD_MS;
    this.waiting = value;
    this.slider.value = String(value);
    const scale = this.inDegrees && this.field.dataset.unit !== "m" ? 180 / Math.PI : 1;
    this.field.value = formatNumber(value * scale, scale === 1 ? 3 : 1);
    this.wishes.push(value);
  }

  private scale(unit: Joint["unit"]): number {
    this.field.dataset.unit = unit;
    return this.inDegrees && unit === "rad" ? 180 / Math.PI : 1;
  }

  private rangeOf({ minimum, maximum, maxVelocity }: Joint): [number, number] {
    if (this.kind === "position") return [minimum, maximum];
    const fastest = Number.isFinite(maxVelocity) ? maxVelocity : USUAL_VELOCITY;
    return [-fastest, fastest];
  }
}

function limitsOf({ minimum, maximum, maxVelocity, maxEffort, unit }: Joint, text: (value: number) => string): string {
  const isFinite = Number.isFinite;
  const parts = [
    isFinite(minimum) && isFinite(maximum) ? `${text(minimum)} to ${text(maximum)}` : "no position limits: the slider sets the velocity",
    isFinite(maxVelocity) && `at most ${text(maxVelocity)}/s`,
    isFinite(maxEffort) && `at most ${formatNumber(maxEffort, 1)} ${unit === "m" ? "N" : "N m"}`,
  ];
  return parts.filter(Boolean).join(", ");
}
