// Shapes that can be added to a world, and their names as models (gsv/formats/sdf/shape_model.h).

export type ShapeKind = "box" | "wall" | "cylinder" | "sphere";

// Lengths in metres. Each kind of shape uses only some of them.
export interface Shape {
  kind: ShapeKind;
  length: number; // along x
  width: number; // along y
  height: number; // along z; also for a cylinder
  radius: number;
  mass: number; // kg
  isStatic: boolean;
  colour: string; // RRGGBB
}

export const FIRST_SHAPE: Shape = {
  kind: "box",
  length: 0.4,
  width: 0.4,
  height: 0.4,
  radius: 0.2,
  mass: 1,
  isStatic: false,
  colour: "c8843c",
};

const SHORTEST = 1e-3; // m
const LONGEST = 1000;

export type LengthName = "length" | "width" | "height" | "radius";

export function lengthsOf(kind: ShapeKind): readonly LengthName[] {
  if (kind === "sphere") return ["radius"];
  return kind === "cylinder" ? ["radius", "height"] : ["length", "width", "height"];
}

// Returns the reason why the shape is invalid; empty if it is valid.
export function faultOf(shape: Shape): string {
  for (const name of lengthsOf(shape.kind)) {
    const value = shape[name];
    if (!(value >= SHORTEST && value <= LONGEST)) return `The ${name} must be ${SHORTEST} to ${LONGEST} m.`;
  }
  if (!shape.isStatic && !(shape.mass >= 1e-6 && shape.mass <= 1e6)) return "The mass must be 0.000001 to 1000000 kg.";
  return "";
}

export function modelOf(shape: Shape): string {
  const { kind, length, width, height, radius, mass, isStatic, colour } = shape;
  const round = kind === "sphere" ? `radius=${radius}` : `radius=${radius}&length=${height}`;
  const size = kind === "box" || kind === "wall" ? `size=${length},${width},${height}` : round;
  return `shape:${kind}?${size}&${isStatic ? "" : `mass=${mass}&`}static=${isStatic}&colour=${colour}`;
}

// Returns the radius of a circle on the floor around the shape.
export function footprintOf({ kind, length, width, radius }: Shape): number {
  return kind === "box" || kind === "wall" ? Math.hypot(length, width) / 2 : radius;
}

export interface FloorPoint {
  x: number;
  y: number;
}

// Returns the wall between two points: its shape, and the pose of its centre.
export function wallBetween(
  from: FloorPoint,
  to: FloorPoint,
  { thickness, height, colour }: { thickness: number; height: number; colour: string },
): { shape: Shape; place: { x: number; y: number; yaw: number } } {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  return {
    shape: { ...FIRST_SHAPE, kind: "wall", length: Number(length.toFixed(3)), width: thickness, height, isStatic: true, colour },
    place: { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2, yaw: Math.atan2(to.y - from.y, to.x - from.x) },
  };
}
