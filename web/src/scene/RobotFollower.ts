// Moves the camera with the selected robot, according to the camera mode. Also draws the ring
// around the selected body.
import type { ViewMode } from "../state/State";
import type { CameraRig } from "./CameraRig";
import { SelectionRing } from "./Ground";
import type { RobotPlaces } from "./RobotPlaces";

export class RobotFollower {
  readonly ring = new SelectionRing();
  robots: RobotPlaces | null = null; // the robots of the present scene
  private robot: string | null = null;
  private object: string | null = null; // the object that the user moves
  private mode: ViewMode = "orbit";

  constructor(private readonly rig: CameraRig) {}

  // The body with the ring: the object that the user moves, else the selected robot.
  get selection(): string | null {
    return this.object ?? this.robot;
  }

  private get isEye(): boolean {
    return this.mode === "eye";
  }

  // Called with every frame.
  showRing(): void {
    const { selection } = this;
    const place = selection === null || this.isEye ? null : this.robots?.ringOf(selection);
    if (place) this.ring.place(place.position, place.radius);
    else this.ring.hide();
  }

  select(robot: string | null): void {
    if (robot !== this.robot) this.rig.follow(null); // so that update() flies to the new robot
    this.robot = robot;
    this.update();
  }

  choose(object: string | null): void {
    this.object = object;
  }

  setMode(mode: ViewMode): void {
    this.mode = mode;
    this.update();
  }

  update(): void {
    const { robots, mode } = this;
    const robot = mode === "orbit" ? null : this.robot;
    this.rig.lookFrom((this.isEye && robot && robots?.eyeOf(robot)) || null);
    this.rig.follow((!this.isEye && robot && robots?.subjectOf(robot)) || null, mode === "chase");
  }

  // Call this when the robot has moved.
  move(): void {
    if (this.robot === null || this.mode === "orbit" || !this.robots) return;
    const subject = this.robots.subjectOf(this.robot);
    if (this.isEye) this.rig.lookFrom(this.robots.eyeOf(this.robot));
    else if (subject) this.rig.moveTo(subject);
  }
}
