// The beams of range sensors as lines, all in one draw call. A beam is measured at one instant and
// shown over several frames: it moves along with its robot as that is shown.
import type { Matrix4 } from "three";
import { Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { MarkerMessage } from "../protocol/messages";
import { LINE_LIST } from "../protocol/messages";
import { segmentsGeometry, uploadSegments } from "./segments";

const WIDTH_PX = 1.5;
const OPACITY = 0.85;
// Where the marker does not colour each beam: a colour of the marker's own says nothing about them.
const BEAM_COLOUR = { r: 1, g: 0.012, b: 0.006 };
const SMALLEST_CAPACITY = 64; // segments
const NUMBERS_PER_POINT = 3;

interface RobotBeams {
  pointsInRobot: Float64Array; // x y z of each end, in the robot's frame at the instant of measuring
  colours: Float32Array; // r g b of each end
}

interface PlacedBeams extends RobotBeams {
  robot: string;
  frame: Matrix4; // world_from_robot, as shown
}

export class BeamLayer {
  readonly lines: LineSegments2;
  private readonly beams = new Map<string, RobotBeams>();
  private readonly material = new LineMaterial({
    linewidth: WIDTH_PX,
    vertexColors: true,
    transparent: true,
    opacity: OPACITY,
    toneMapped: false,
  });
  private capacity = 0;
  private positions = new Float32Array(0);
  private colours = new Float32Array(0);

  // Draws at most so many beams.
  constructor(private readonly most: number) {
    this.lines = new LineSegments2(segmentsGeometry(this.positions, this.colours), this.material);
    this.lines.frustumCulled = false;
    this.lines.raycast = () => {};
    this.grow(SMALLEST_CAPACITY);
  }

  get segments(): number {
    return (this.lines.geometry as LineSegmentsGeometry).instanceCount;
  }

  // One robot's beams, as lines in the world at the instant when it stood at `worldFromRobot`.
  setRobot(robot: string, marker: MarkerMessage, worldFromRobot: Matrix4): void {
    if (marker.type !== LINE_LIST || marker.action !== 0 || marker.points.length < 2) {
      this.beams.delete(robot);
      return;
    }
    const ends = marker.points.length - (marker.points.length % 2);
    const robotFromWorld = worldFromRobot.clone().invert();
    const pointsInRobot = new Float64Array(NUMBERS_PER_POINT * ends);
    const colours = new Float32Array(NUMBERS_PER_POINT * ends);
    const point = new Vector3();
    for (let i = 0; i < ends; i++) {
      const { x, y, z } = marker.points[i]!;
      point
        .set(x, y, z)
        .applyMatrix4(robotFromWorld)
        .toArray(pointsInRobot, 3 * i);
      const { r, g, b } = marker.colors[i] ?? BEAM_COLOUR;
      colours.set([r, g, b], 3 * i);
    }
    this.beams.set(robot, { pointsInRobot, colours });
  }

  keepOnly(robots: ReadonlySet<string>): void {
    for (const robot of [...this.beams.keys()]) if (!robots.has(robot)) this.beams.delete(robot);
  }

  // Places the beams with the robots as they are shown now. Where there are more than can be drawn,
  // those of the robots with the lowest `rank` are.
  place(worldFromRobot: (robot: string) => Matrix4 | null, rank: (robot: string, frame: Matrix4) => number): void {
    const placed = [...this.beams].flatMap(([robot, beams]) => {
      const frame = worldFromRobot(robot);
      return frame ? [{ ...beams, frame, robot }] : [];
    });
    const drawn = this.chosen(placed, rank);
    const ends = drawn.reduce((sum, { pointsInRobot }) => sum + pointsInRobot.length / 3, 0);
    if (ends / 2 > this.capacity) this.grow(ends / 2);
    const point = new Vector3();
    let at = 0;
    for (const { frame, pointsInRobot, colours } of drawn) {
      this.colours.set(colours, at);
      for (let i = 0; i < pointsInRobot.length; i += 3) {
        point.fromArray(pointsInRobot, i).applyMatrix4(frame).toArray(this.positions, at);
        at += 3;
      }
    }
    uploadSegments(this.lines.geometry as LineSegmentsGeometry, at / 6);
  }

  private chosen(placed: PlacedBeams[], rank: (robot: string, frame: Matrix4) => number): PlacedBeams[] {
    const count = (beams: readonly PlacedBeams[]) => beams.reduce((sum, { pointsInRobot }) => sum + pointsInRobot.length / 6, 0);
    if (count(placed) <= this.most) return placed;
    const ranked = placed.map((each) => ({ each, rank: rank(each.robot, each.frame) })).sort((a, b) => a.rank - b.rank);
    let left = this.most;
    return ranked.flatMap(({ each }) => ((left -= each.pointsInRobot.length / 6) >= 0 ? [each] : []));
  }

  dispose(): void {
    this.lines.geometry.dispose();
    this.material.dispose();
    this.lines.removeFromParent();
  }

  private grow(segments: number): void {
    this.capacity = Math.max(SMALLEST_CAPACITY, 2 ** Math.ceil(Math.log2(segments)));
    this.positions = new Float32Array(6 * this.capacity);
    this.colours = new Float32Array(6 * this.capacity);
    this.lines.geometry.dispose();
    this.lines.geometry = segmentsGeometry(this.positions, this.colours);
  }
}
