// The form for one robot or avatar: its model, its start, and its behaviour.
import type { App } from "../app/App";
import type { RobotList, RobotSetUp } from "../api/scenario";
import type { SetUp } from "../state/setUp";
import { element, setText } from "../ui/element";
import { icon } from "../ui/icons";
import type { Field } from "../ui/fields";
import { choiceField, choiceOrText, numberField, textField } from "../ui/fields";

const DEGREES = 180 / Math.PI;
const BY_CONSTRAINT = { choice: "By constraint…", placeholder: "name == 'wander' and time_managed" };
const BY_PATH = { choice: "A file or folder…", placeholder: "path/to/model" };

export class RobotRow {
  readonly element: HTMLLIElement;
  private readonly wrong = element("p", { class: "field-error", role: "alert" });
  private readonly title = element("span", {});
  private readonly fields: Map<string, Field<never>>;
  private readonly model;
  private readonly behaviour;
  private readonly name;
  private readonly movement;
  private readonly drive;
  private readonly namespace;
  private readonly x = this.place("x (m)", 1, 3, (value) => ({ x: value }));
  private readonly y = this.place("y (m)", 1, 3, (value) => ({ y: value }));
  private readonly yaw = this.place("Heading (°)", DEGREES, 1, (value) => ({ yaw: value }));
  private robot: RobotSetUp | null = null;

  constructor(
    private readonly app: App,
    private readonly list: RobotList,
    private readonly index: number,
  ) {
    this.name = textField("Name", "default: name of the model", (name) => this.change({ name }));
    this.model = choiceOrText("Model", BY_PATH, (model) => this.change({ model }));
    this.behaviour = choiceOrText("Behaviour", BY_CONSTRAINT, (value) => this.changeBehaviour(value));
    this.movement = choiceField("Moves", (value) =>
      this.change({ movement: value === "planar" || value === "rigid" ? value : "" }),
    );
    this.movement.offer([
      { value: "", label: "As the model says" },
      { value: "planar", label: "Planar: 2D kinematics on level ground" },
      { value: "rigid", label: "Rigid: rigid-body dynamics" },
    ]);
    this.drive = textField("Drive", "diff, skid,radius=0.16, … (default: drive of the model, else guessed from its wheels)", (drive) =>
      this.change({ drive }),
    );
    this.namespace = textField("ROS 2 namespace", "default: /NAME of the robot; /: no namespace", (namespace) => this.change({ namespace }));
    this.fields = new Map<string, Field<never>>([
      ["name", this.name],
      ["model", this.model],
      ["behaviour", this.behaviour],
      ["behaviour_constraint", this.behaviour],
      ["movement", this.movement],
      ["drive", this.drive],
      ["x", this.x],
      ["y", this.y],
      ["yaw", this.yaw],
    ]);
    this.wrong.hidden = true;
    for (const { element } of [this.behaviour, this.movement, this.drive]) element.hidden = list === "avatars";
    this.element = this.build();
  }

  show(robot: RobotSetUp, setUp: SetUp): void {
    this.robot = robot;
    setText(this.title, robot.name || robot.model);
    const models = setUp.models.filter(({ isAvatar }) => isAvatar === (this.list === "avatars"));
    this.model.offer(models.map(({ name }) => ({ value: name, label: name })));
    this.behaviour.offer(behaviourOptions(setUp, robot));
    this.name.show(robot.name);
    this.model.show(robot.model);
    this.behaviour.show(robot.constraint || robot.behaviour);
    this.movement.show(robot.movement);
    this.drive.show(robot.drive);
    this.namespace.show(robot.namespace ?? "");
    this.namespace.element.hidden = this.list === "avatars" || setUp.scenario.ros2 === null;
    this.x.show(robot.place?.x ?? null);
    this.y.show(robot.place?.y ?? null);
    this.yaw.show(robot.place ? robot.place.yaw * DEGREES : null);
  }

  // `input` is the name of the field. If it is empty, or if the field has no input, the error is
  // shown for the whole robot.
  refuse(input: string, sentence: string): void {
    for (const field of this.fields.values()) field.refuse("");
    const field = this.fields.get(input);
    field?.refuse(sentence);
    const ofAll = field ? "" : sentence;
    setText(this.wrong, ofAll);
    this.wrong.hidden = ofAll === "";
  }

  setSelected(selected: boolean): void {
    this.element.classList.toggle("selected", selected);
  }

  private build(): HTMLLIElement {
    const select = element(
      "button",
      { class: "button plain robot-title", type: "button", onclick: () => this.select() },
      this.title,
    );
    const place = element(
      "button",
      {
        class: "button plain small",
        type: "button",
        title: "Place the robot by a click on the floor",
        onclick: () => {
          this.select();
          this.app.pointing.setPlacing(true);
        },
      },
      "Place",
    );
    const remove = element(
      "button",
      {
        class: "button plain small",
        type: "button",
        "aria-label": this.list === "avatars" ? "Remove avatar" : "Remove robot",
        title: "Remove",
        onclick: () => this.app.setUp.removeRobot(this.list, this.index),
      },
      icon("close"),
    );
    return element(
      "li",
      { class: "set-up-robot", "data-row": `${this.list}[${this.index}]` },
      element("div", { class: "card-head" }, select, place, remove),
      this.wrong,
      element("div", { class: "field-pair" }, this.name.element, this.model.element),
      element("div", { class: "field-pair" }, this.behaviour.element, this.movement.element),
      element("div", { class: "field-pair" }, this.drive.element, this.namespace.element),
      element("div", { class: "field-pair" }, this.x.element, this.y.element, this.yaw.element),
    );
  }

  private select(): void {
    this.app.select(this.robot?.name ?? null);
  }

  private change(change: Partial<RobotSetUp>): void {
    this.app.setUp.changeRobot(this.list, this.index, change);
  }

  // `value` is the name of an offered behaviour, or the present name, or empty. Every other text is
  // a constraint, with which the behaviour is chosen from the offers.
  private changeBehaviour(value: string): void {
    const offers = this.app.store.get().setUp?.behaviours?.offers ?? [];
    const isName = value === "" || offers.some(({ name }) => name === value) || value === this.robot?.behaviour;
    this.change(isName ? { behaviour: value, constraint: "" } : { behaviour: "", constraint: value });
  }

  private place(
    label: string,
    scale: number,
    digits: number,
    patch: (value: number) => object,
  ): Field<number | null> {
    const take = (value: number | null) => {
      const place = this.robot?.place ?? { x: 0, y: 0, yaw: 0 };
      this.change({ place: value === null ? null : { ...place, ...patch(value / scale) } });
    };
    return numberField(label, null, take, { digits });
  }
}

// The choices: no behaviour, and each offer once. If the file names a behaviour that is not
// offered, it is also a choice.
function behaviourOptions({ behaviours }: SetUp, { behaviour }: RobotSetUp) {
  const names = [...new Set((behaviours?.offers ?? []).map(({ name }) => name))].sort();
  const options = names.map((name) => ({ value: name, label: name }));
  if (behaviour && !names.includes(behaviour)) {
    options.push({ value: behaviour, label: `${behaviour} (not offered now)` });
  }
  return [{ value: "", label: "None: the robot moves only if you or ROS 2 nodes drive it" }, ...options];
}
