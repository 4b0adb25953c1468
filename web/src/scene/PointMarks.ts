// Points that the user has clicked, and the lines between them: the ends of a ruler, or the first
// end of a wall.
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import type { Point } from "../state/State";

const COLOUR = 0xd1242f;
const RADIUS = 0.04; // m
const LOOK = { color: COLOUR, depthTest: false, transparent: true, toneMapped: false };

export class PointMarks {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial(LOOK);
  private readonly geometry = new SphereGeometry(RADIUS, 12, 8);
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial(LOOK));

  constructor() {
    this.group.renderOrder = this.lines.renderOrder = 3;
    this.lines.raycast = () => {};
  }

  show(points: readonly Point[]): void {
    this.group.clear();
    for (const { x, y, z } of points) {
      const mark = new Mesh(this.geometry, this.material);
      mark.position.set(x, y, z);
      mark.renderOrder = 3;
      mark.raycast = () => {};
      this.group.add(mark);
    }
    const ends = points.slice(1).flatMap((point, i) => [points[i]!, point]);
    const line = new BufferGeometry();
    line.setAttribute("position", new Float32BufferAttribute(ends.flatMap(({ x, y, z }) => [x, y, z]), 3));
    line.setDrawRange(0, ends.length);
    this.lines.geometry.dispose();
    this.lines.geometry = line;
    this.lines.frustumCulled = false;
    if (ends.length > 0) this.group.add(this.lines);
  }
}
