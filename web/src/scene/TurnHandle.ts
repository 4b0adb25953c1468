// An arrow on the floor that shows a robot's heading. Dragging its tip rotates the robot.
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from "three";
import { Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";

const COLOUR = 0x2f81f7;
const SHAFT = 0.45; // m: length beyond the ring
const TIP_RADIUS = 0.07; // m
const ABOVE_FLOOR = 0.03; // m

export class TurnHandle {
  readonly group = new Group();
  private readonly shaft: LineSegments;
  private readonly knob: Mesh;

  constructor() {
    const look = { color: COLOUR, depthTest: false, transparent: true, toneMapped: false };
    const line = new BufferGeometry();
    line.setAttribute("position", new Float32BufferAttribute([0, 0, 0, 1, 0, 0], 3));
    this.shaft = new LineSegments(line, new LineBasicMaterial(look));
    this.knob = new Mesh(new SphereGeometry(TIP_RADIUS, 16, 12), new MeshBasicMaterial(look));
    this.shaft.raycast = this.knob.raycast = () => {};
    this.group.add(this.shaft, this.knob);
    this.group.renderOrder = this.shaft.renderOrder = this.knob.renderOrder = 2;
    this.group.visible = false;
  }

  // Moves the arrow to a robot's place on the floor. `radius` is the radius of the ring around the
  // robot.
  show(position: Vector3, yaw: number, radius: number): void {
    this.group.visible = true;
    this.group.position.set(position.x, position.y, position.z + ABOVE_FLOOR);
    this.group.rotation.z = yaw;
    this.shaft.scale.x = radius + SHAFT;
    this.knob.position.x = radius + SHAFT;
    this.group.updateMatrixWorld(true);
  }

  hide(): void {
    this.group.visible = false;
  }

  // The place of the tip in the world; null while the arrow is hidden.
  get tip(): Vector3 | null {
    return this.group.visible ? this.knob.getWorldPosition(new Vector3()) : null;
  }
}
