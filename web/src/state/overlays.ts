// The overlays of the view. A menu or a key switches each overlay. The browser stores the choice.

export interface OverlayKind {
  name: OverlayName;
  label: string;
  key: string;
  hint: string;
}

export const OVERLAY_NAMES = [
  "beams",
  "points",
  "contacts",
  "cameras",
  "trails",
  "frames",
  "labels",
  "states",
  "grid",
  "collisions",
  "joints",
  "masses",
  "actuators",
  "sound",
] as const;
export type OverlayName = (typeof OVERLAY_NAMES)[number];
export type Shown = Record<OverlayName, boolean>;

export const OVERLAYS: readonly OverlayKind[] = [
  { name: "beams", label: "Beams", key: "1", hint: "Readings of sonars and other range sensors" },
  { name: "points", label: "Points", key: "2", hint: "Lidar and depth camera points" },
  { name: "contacts", label: "Contacts", key: "3", hint: "Contact points of all bodies, and the forces at them" },
  { name: "cameras", label: "Fields of view", key: "4", hint: "Fields of view of the cameras" },
  { name: "trails", label: "Trails", key: "5", hint: "Paths of the robots" },
  { name: "frames", label: "Frames", key: "6", hint: "Axes of robots, moving links and sensors" },
  { name: "labels", label: "Names", key: "7", hint: "Names of the robots" },
  { name: "states", label: "States", key: ";", hint: "Marks on robots with problems, and on robots that are too far away to see" },
  { name: "grid", label: "Grid", key: "8", hint: "Grid with 1 m cells" },
  { name: "collisions", label: "Collision shapes", key: "9", hint: "Collision shapes used by the physics" },
  { name: "joints", label: "Joints", key: "0", hint: "Axes of the joints" },
  { name: "masses", label: "Masses", key: "B", hint: "Centre of mass of each link, and a box that has the link's inertia" },
  { name: "actuators", label: "Actuators and radio", key: "-", hint: "State of lamps, speakers, grippers and radios" },
  { name: "sound", label: "Sound", key: "=", hint: "Play the sound of the robots' loudspeakers" },
];

export const FIRST_SHOWN: Shown = {
  beams: true,
  points: false,
  contacts: false,
  cameras: false,
  trails: false,
  frames: false,
  labels: true,
  states: true,
  grid: true,
  collisions: false,
  joints: false,
  masses: false,
  actuators: true,
  sound: false,
};

// The quantities that the colours of points and trails can show, each with its label in the page.
export const POINT_COLOURS = { range: "distance", height: "height", intensity: "intensity" } as const;
export const TRAIL_COLOURS = { robot: "robot", speed: "speed" } as const;
export type PointColour = keyof typeof POINT_COLOURS;
export type TrailColour = keyof typeof TRAIL_COLOURS;

export interface OverlayColours {
  points: PointColour;
  trails: TrailColour;
}

export const FIRST_COLOURS: OverlayColours = { points: "range", trails: "robot" };

const COLOURS_KEY = "gsv.overlayColours";

export function loadColours(storage: Pick<Storage, "getItem"> | null): OverlayColours {
  try {
    const { points, trails } = JSON.parse(storage?.getItem(COLOURS_KEY) ?? "{}") as Record<string, unknown>;
    return {
      points: isKeyOf(POINT_COLOURS, points) ? points : FIRST_COLOURS.points,
      trails: isKeyOf(TRAIL_COLOURS, trails) ? trails : FIRST_COLOURS.trails,
    };
  } catch {
    return FIRST_COLOURS; // the stored text was written by another program
  }
}

export function keepColours(storage: Pick<Storage, "setItem"> | null, colours: OverlayColours): void {
  try {
    storage?.setItem(COLOURS_KEY, JSON.stringify(colours));
  } catch {
    // Nothing is saved if the storage is full, or if the browser does not allow storage, as in a
    // private window.
  }
}

function isKeyOf<Names extends object>(names: Names, value: unknown): value is keyof Names {
  return typeof value === "string" && Object.hasOwn(names, value);
}

const KEY = "gsv.overlays";

// Reads the stored choice. If an entry is missing or invalid, its default is used.
export function loadShown(storage: Pick<Storage, "getItem"> | null): Shown {
  let kept: unknown = null;
  try {
    kept = JSON.parse(storage?.getItem(KEY) ?? "null");
  } catch {
    // Ignored: the stored text was written by another program.
  }
  const flags = (typeof kept === "object" && kept !== null ? kept : {}) as Record<string, unknown>;
  const shown = { ...FIRST_SHOWN };
  for (const name of OVERLAY_NAMES) if (typeof flags[name] === "boolean") shown[name] = flags[name];
  return shown;
}

export function keepShown(storage: Pick<Storage, "setItem"> | null, shown: Shown): void {
  try {
    storage?.setItem(KEY, JSON.stringify(shown));
  } catch {
    // Nothing is saved if the storage is full, or if the browser does not allow storage, as in a
    // private window.
  }
}

// Returns null if the browser does not allow storage.
export function browserStorage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
