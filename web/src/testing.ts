// window.gsv contains what browser tests and scripts can query. web/README.md documents it. Nothing
// else in the page uses it.
import type { World3D } from "./scene/World3D";
import { allChosen } from "./state/editing";
import type { State } from "./state/State";
import type { Store } from "./state/Store";

export interface PageHandle {
  // Resolves when the first scene is drawn with all its shapes.
  ready: Promise<void>;
  // The number of frames drawn so far.
  readonly frames: number;
  // Whether a frame is being drawn or requested.
  readonly isDrawing: boolean;
  // The delays of the server's last images, in ms: from a state of the world to its image on the
  // screen.
  readonly imageDelaysMs: readonly number[];
  // The displayed simulated time, in seconds.
  readonly time: number;
  readonly phase: string | null;
  // The position and the target of the camera: x y z each, in metres; null without a 3D view.
  readonly view: number[] | null;
  // The topics that the page reads.
  readonly topics: string[];
  // The names of the robots.
  readonly robots: string[];
  // The last reported position of the robot in metres, and its simulated time; null while unknown.
  robotPosition(name: string): { x: number; y: number; z: number; time: number } | null;
  // The place where the ghost of this robot is drawn, in metres; null if there is no ghost. Ghosts
  // are the robots of the second recording of a comparison.
  ghostPosition(name: string): { x: number; y: number } | null;
  // The place where the robot's centre is drawn, in CSS pixels of the page; null if it is outside
  // the view.
  robotScreenPosition(name: string): { x: number; y: number } | null;
  // The labels in the view, the most important one first. The boxes are in CSS pixels of the page.
  readonly labels: readonly { name: string; kind: string; x: number; y: number; width: number; height: number }[];
  // The place where the tip of the selected robot's arrow is drawn; null while it is hidden.
  turnHandle(): { x: number; y: number } | null;
  // The place of the gizmo's handle for this axis of the world; null while it is hidden.
  gizmoHandle(axis: "x" | "y" | "z"): { x: number; y: number } | null;
  // The selected bodies. The body that was selected first is the first one.
  readonly chosen: readonly string[];
}

declare global {
  interface Window {
    gsv: PageHandle;
  }
}

export function exposeForTests(store: Store<State>, world: () => World3D | null, topics: () => string[] = () => []): void {
  window.gsv = {
    ready: firstPicture(store, world),
    get frames() {
      return world()?.frames ?? 0;
    },
    get isDrawing() {
      return world()?.isDrawing ?? false;
    },
    get imageDelaysMs() {
      return world()?.imageDelaysMs ?? [];
    },
    get time() {
      return store.get().time;
    },
    get phase() {
      return store.get().status?.phase ?? null;
    },
    get view() {
      return world()?.viewpoint ?? null;
    },
    get topics() {
      return topics();
    },
    get robots() {
      return store.get().status?.robots.map(({ name }) => name) ?? [];
    },
    robotPosition: (name) => {
      const latest = world()?.latestPose(name);
      if (!latest) return null;
      const [x, y, z] = latest.pose.elements.slice(12) as [number, number, number];
      return { x, y, z, time: latest.stamp };
    },
    ghostPosition: (name) => {
      const place = world()?.ghostPlace(name);
      return place ? { x: place[0], y: place[1] } : null;
    },
    robotScreenPosition: (name) => world()?.screenPosition(name) ?? null,
    get labels() {
      return world()?.labels ?? [];
    },
    turnHandle: () => world()?.turnHandle() ?? null,
    gizmoHandle: (axis) => world()?.tools.gizmo.handleAt(axis) ?? null,
    get chosen() {
      return allChosen(store.get());
    },
  };
}

function firstPicture(store: Store<State>, world: () => World3D | null): Promise<void> {
  return new Promise((resolve) => {
    let framesThen: number | null = null; // number of frames when the last shape arrived; null while a shape is missing
    const check = () => {
      if (framesThen === null) return;
      if ((world()?.frames ?? Infinity) <= framesThen) {
        requestAnimationFrame(check);
        return;
      }
      unwatch();
      resolve();
    };
    // For a moment, a scene exists, but the view has not yet reported how many of its shapes are
    // missing.
    const unwatch = store.watch(
      ({ view, scene, modelsMissing }) => view !== "starting" && scene !== null && modelsMissing === 0,
      (isComplete) => {
        framesThen = isComplete ? (world()?.frames ?? 0) : null;
        if (isComplete) requestAnimationFrame(check);
      },
    );
  });
}
