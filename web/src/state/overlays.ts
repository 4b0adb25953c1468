// The overlays of the view. Each can be switched by menu or key, and the browser stores the choice.

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
  "actuators",
  "sound",
] as const;
export type OverlayName = (typeof OVERLAY_NAMES)[number];
export type Shown = Record<OverlayName, boolean>;

export const OVERLAYS: readonly OverlayKind[] = [
  { name: "beams", label: "Beams", key: "1", hint: "Readings of sonars and other range sensors" },
  { name: "points", label: "Points", key: "2", hint: "Lidar and depth camera points" },
  { name: "contacts", label: "Contacts", key: "3", hint: "Contact points of bumpers" },
  { name: "cameras", label: "Camera views", key: "4", hint: "Camera frustums" },
  { name: "trails", label: "Trails", key: "5", hint: "Paths of the robots" },
  { name: "frames", label: "Frames", key: "6", hint: "Axes of robots, moving links and sensors" },
  { name: "labels", label: "Names", key: "7", hint: "Names of the robots" },
  { name: "states", label: "States", key: ";", hint: "Marks at robots that are far away or in trouble" },
  { name: "grid", label: "Grid", key: "8", hint: "Grid with 1 m cells" },
  { name: "collisions", label: "Collision shapes", key: "9", hint: "Collision shapes used by the physics" },
  { name: "joints", label: "Joints", key: "0", hint: "Axes of the joints" },
  { name: "actuators", label: "Actuators and radio", key: "-", hint: "State of lamps, speakers, grippers and radios" },
  { name: "sound", label: "Sound", key: "=", hint: "Play the sound of the robots' loudspeakers" },
];

export const FIRST_SHOWN: Shown = {
  beams: true,
  points: false,
  contacts: true,
  cameras: false,
  trails: false,
  frames: false,
  labels: true,
  states: true,
  grid: true,
  collisions: false,
  joints: false,
  actuators: true,
  sound: false,
};

const KEY = "gsv.overlays";

// Reads the stored choice. Missing or invalid entries have their default.
export function loadShown(storage: Pick<Storage, "getItem"> | null): Shown {
  let kept: unknown = null;
  try {
    kept = JSON.parse(storage?.getItem(KEY) ?? "null");
  } catch {
    // The stored text comes from another program.
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
    // If the storage is full or not allowed, nothing is saved, as in a private window.
  }
}

// null if the browser does not allow it.
export function browserStorage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
