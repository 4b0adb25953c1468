// The panel of the simulation's commands. Each command has a form, which is made from the server's
// description.
import type { CommandArguments, CommandDescription, CommandParameter, CommandValue } from "../../api/commands";
import { canAct } from "../../state/actions";
import { element, setText } from "../../ui/element";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "commands">;

export function mount({ state, commands }: Ports): MountedPanel {
  const forms = element("div", { class: "facts-body" });
  const note = element("p", { class: "log-empty", role: "status" });
  const body = element("div", {}, note, forms);
  let shown: string | null = null; // the simulation whose commands are shown

  const setEnabled = (isEnabled: boolean) =>
    forms.querySelectorAll("button").forEach((button) => (button.disabled = !isEnabled));
  const say = (sentence: string) => {
    setText(note, sentence);
    note.hidden = sentence === "";
  };
  const show = async (simulation: string | null) => {
    if (simulation === shown && simulation !== null) return;
    shown = simulation;
    forms.replaceChildren();
    if (simulation === null) return say("No simulation. Open one to see its commands.");
    say("Loading commands…");
    try {
      const list = await commands.list(simulation);
      if (shown !== simulation) return;
      const run = (name: string, given: CommandArguments) => commands.run(simulation, name, given);
      forms.replaceChildren(...list.map((command) => createForm(command, run)));
      setEnabled(canAct(state.get()));
      say("");
    } catch (error) {
      if (shown !== simulation) return;
      shown = null; // so that the commands are requested again when the panel is opened again
      say((error as Error).message);
    }
  };
  const whileOpen = () => {
    const ends = [
      state.watch(
        (known) => known.simulation,
        (simulation) => void show(simulation),
      ),
      state.watch(canAct, setEnabled),
    ];
    return () => ends.forEach((end) => end());
  };
  return { body, whileOpen };
}

function createForm(command: CommandDescription, run: (name: string, given: CommandArguments) => Promise<void>) {
  const fields = command.parameters.map(createField);
  const answer = element("output", { class: "command-answer" });
  const title = command.name.replaceAll("_", " ");
  const button = element(
    "button",
    { class: "button plain small", type: "submit", title: command.summary },
    title.charAt(0).toUpperCase() + title.slice(1),
  );
  const submit = async (event: Event) => {
    event.preventDefault();
    setText(answer, "");
    const given: CommandArguments = {};
    for (const { name, read } of fields) {
      const value = read();
      if (value !== null) given[name] = value;
    }
    try {
      await run(command.name, given);
      answer.classList.remove("field-error");
      setText(answer, "Done.");
    } catch (error) {
      answer.classList.add("field-error");
      setText(answer, (error as Error).message);
    }
  };
  return element(
    "form",
    { class: "facts command-form", "aria-label": command.summary, onsubmit: (event: Event) => void submit(event) },
    ...fields.map((field) => field.element),
    button,
    answer,
  );
}

// A labelled control. `read` returns null for an argument that is omitted.
function createField(parameter: CommandParameter): {
  name: string;
  element: HTMLElement;
  read(): CommandValue | null;
} {
  const { name, type, unit, summary, isRequired, minimum, maximum, otherwise } = parameter;
  const isNumber = type === "number" || type === "integer";
  const input = element("input", {
    type: type === "flag" ? "checkbox" : isNumber ? "number" : "text",
    name,
    title: summary + (isNumber ? rangeText(minimum, maximum) : ""),
    ...(isNumber && { step: type === "integer" ? "1" : "any" }),
    ...(isNumber && Number.isFinite(minimum) && { min: String(minimum) }),
    ...(isNumber && Number.isFinite(maximum) && { max: String(maximum) }),
    ...(type !== "flag" && otherwise && { placeholder: otherwise }),
    ...(type !== "flag" && isRequired && { required: true }),
  });
  if (type === "flag") input.checked = otherwise === "true";
  const label = element("label", {}, unit ? `${name} (${unit}) ` : `${name} `, input);
  const read = () => {
    if (type === "flag") return input.checked;
    if (input.value === "") return null;
    return isNumber ? Number(input.value) : input.value;
  };
  return { name, element: label, read };
}

function rangeText(minimum: number, maximum: number): string {
  const from = Number.isFinite(minimum) ? ` from ${minimum}` : "";
  const to = Number.isFinite(maximum) ? ` to ${maximum}` : "";
  return from || to ? `,${from}${to}` : "";
}
