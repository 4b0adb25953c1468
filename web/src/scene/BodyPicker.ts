// Finds the bodies under the pointer. Places are in CSS pixels of the page.
import type { PerspectiveCamera } from "three";
import { Vector3 } from "three";
import type { SceneBody } from "../api/scene";
import { hasAgent } from "../api/scene";
import type { BodyLayer } from "./BodyLayer";
import type { ScreenPlace } from "./picking";
import { nearest, rayThrough, screenPlaceOf } from "./picking";
import type { RobotPlaces } from "./RobotPlaces";

const GROUND_WIDTH = 4; // m: smallest width of a floor
const GROUND_FLATNESS = 0.05; // largest height of a floor, as a fraction of its width

export interface PickedView {
  host: HTMLElement;
  camera(): PerspectiveCamera;
  bodies(): BodyLayer | null;
  robots(): RobotPlaces | null;
}

export class BodyPicker {
  constructor(private readonly view: PickedView) {}

  // Returns the robot, avatar or station at a place. If there is none, returns the nearest one that
  // is drawn close to the place.
  robotAt(place: ScreenPlace): string | null {
    const hit = this.bodyAt(place);
    if (hit && hasAgent(hit)) return hit.name;
    const robots = this.view.robots()?.names ?? [];
    return nearest(
      place,
      robots.map((name) => ({ name, at: this.robotOnScreen(name) })),
    );
  }

  // Returns the body at a place; null if there is none, or only the ground.
  objectAt(place: ScreenPlace): string | null {
    const hit = this.bodyAt(place);
    return hit && !this.isGround(hit) ? hit.name : null;
  }

  // Returns the movable body at a place; null if there is none.
  movableAt(place: ScreenPlace): string | null {
    const hit = this.bodyAt(place);
    return hit && !hit.isFixed ? hit.name : null;
  }

  // Returns the static body at a place, if a user has added it; otherwise null.
  addedStaticAt(place: ScreenPlace): string | null {
    const hit = this.bodyAt(place);
    return hit?.isStatic && !hit.isFixed ? hit.name : null;
  }

  // Returns the place on the page where a robot's centre is drawn; null if it is outside the view.
  robotOnScreen(robot: string): ScreenPlace | null {
    const middle = this.view.robots()?.middleOf(robot);
    if (!middle) return null;
    return screenPlaceOf(middle, this.view.camera(), this.view.host.getBoundingClientRect());
  }

  // Whether a body is a floor: a wide and flat part of the world. A click on it clears the selection.
  private isGround(body: SceneBody): boolean {
    const bodies = this.view.bodies();
    const size = bodies?.templateOf(bodies.indexOf(body.name))?.bounds.getSize(new Vector3());
    if (!body.isFixed || !size) return false;
    return Math.min(size.x, size.y) >= GROUND_WIDTH && size.z <= GROUND_FLATNESS * Math.min(size.x, size.y);
  }

  private bodyAt(place: ScreenPlace): SceneBody | null {
    const { host, camera } = this.view;
    return this.view.bodies()?.pick(rayThrough(place, host.getBoundingClientRect(), camera())) ?? null;
  }
}
