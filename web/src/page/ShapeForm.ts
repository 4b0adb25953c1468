// The form that adds boxes, cylinders, spheres and walls of a given size. A wall can also be drawn
// with two clicks on the floor.
import type { App } from "../app/App";
import type { LengthName, Shape, ShapeKind } from "../state/shapes";
import { FIRST_SHAPE, faultOf, lengthsOf } from "../state/shapes";
import type { Field } from "../ui/fields";
import { checkField, choiceField, colourField, numberField } from "../ui/fields";
import { element, setText } from "../ui/element";

const LABELS: Record<LengthName, string> = { length: "Length x (m)", width: "Width y (m)", height: "Height z (m)", radius: "Radius (m)" };
const FIRST_WALL: Partial<Shape> = { length: 2, width: 0.1, height: 2, isStatic: true, colour: "b4b4b4" };

// `onAdd` is called when a shape was added, or the user begins to draw a wall.
export function createShapeForm(app: App, onAdd: () => void): HTMLElement {
  let shape: Shape = FIRST_SHAPE;
  const change = (change: Partial<Shape>) => {
    shape = { ...shape, ...change };
    show();
  };
  const kind = choiceField("Shape", (value) =>
    change({ ...FIRST_SHAPE, ...(value === "wall" && FIRST_WALL), kind: value as ShapeKind }),
  );
  kind.offer([
    { value: "box", label: "Box" },
    { value: "cylinder", label: "Cylinder" },
    { value: "sphere", label: "Sphere" },
    { value: "wall", label: "Wall" },
  ]);
  const lengths = new Map<LengthName, Field<number | null>>(
    (["length", "width", "radius", "height"] as const).map((name) => [
      name,
      numberField(LABELS[name], null, (value) => change({ [name]: value ?? NaN }), { least: "0.001", digits: 4 }),
    ]),
  );
  const mass = numberField("Mass (kg)", null, (value) => change({ mass: value ?? NaN }), { least: "0.000001" });
  const isStatic = checkField("Static", (value) => change({ isStatic: value }));
  const colour = colourField("Colour", (value) => change({ colour: value }));
  const at: { x: number | null; y: number | null } = { x: null, y: null };
  const atField = (axis: "x" | "y") => {
    const field = numberField(`At ${axis} (m)`, null, (value) => field.show((at[axis] = value)));
    return field;
  };
  const atFields = [atField("x"), atField("y")];
  const hint = element(
    "p",
    { class: "hint" },
    "Without a position, the shape is added in front of the selected robot, or in the middle of the view if no robot is selected.",
  );
  const fault = element("p", { class: "field-error", role: "alert" });
  const addShape = async () => {
    if (await app.editActions.addShape(shape, at)) onAdd();
  };
  const drawWall = () => {
    onAdd();
    toggleWall(app, shape);
  };
  const add = element("button", { class: "button", type: "button", onclick: () => void addShape() }, "Add shape");
  const draw = element(
    "button",
    { class: "button", type: "button", title: "Draw the wall by two clicks on the floor", onclick: drawWall },
    "Draw wall",
  );
  const show = () => {
    const shown = lengthsOf(shape.kind);
    for (const [name, field] of lengths) {
      field.element.hidden = !shown.includes(name);
      field.show(Number.isFinite(shape[name]) ? shape[name] : null);
    }
    kind.show(shape.kind);
    mass.show(Number.isFinite(shape.mass) ? shape.mass : null);
    mass.element.hidden = shape.isStatic;
    isStatic.show(shape.isStatic);
    colour.show(shape.colour);
    draw.hidden = shape.kind !== "wall";
    const why = faultOf(shape);
    setText(fault, why);
    fault.hidden = why === "";
    allow();
  };
  const allow = () => {
    const { editing } = app.store.get();
    add.disabled = draw.disabled = faultOf(shape) !== "" || editing === null || editing.isBusy;
  };
  app.store.watch(({ editing }) => editing?.isBusy, allow);
  app.store.watch(
    ({ editing }) => editing?.wall != null,
    (isDrawing) => draw.setAttribute("aria-pressed", String(isDrawing)),
  );
  show();
  return element(
    "div",
    { class: "shape-form" },
    element("div", { class: "field-pair" }, kind.element, colour.element),
    element("div", { class: "field-pair" }, ...[...lengths.values()].map(({ element }) => element)),
    element("div", { class: "field-pair" }, mass.element, isStatic.element),
    element("div", { class: "field-pair" }, ...atFields.map(({ element }) => element)),
    hint,
    fault,
    element("div", { class: "edit-buttons" }, add, draw),
  );
}

function toggleWall(app: App, { width, height, colour }: Shape): void {
  const isDrawing = app.store.get().editing?.wall != null;
  app.pointing.drawWall(isDrawing ? null : { thickness: width, height, colour });
}
