// Draws the beams of range sensors as lines in one draw call. A beam is measured at one instant and
// drawn in several frames. In these frames, it moves with the displayed robot.
import type { Matrix4 } from "three";
import { Vector3 } from "three";
import type { RobotBeams } from "../protocol/beams";
import { Segments } from "./Segments";

const WIDTH_PX = 1.5;
const OPACITY = 0.85;
const SMALLEST_CAPACITY = 64; // segments
const NUMBERS_PER_POINT = 3;

interface StoredBeams {
  // x y z of each end, in the robot's frame at the time of the measurement
  pointsInRobot: Float64Array;
  colours: Float32Array; // r g b of each end
}

interface PlacedBeams extends StoredBeams {
  robot: string;
  frame: Matrix4; // world_from_robot, as shown
}

export class BeamLayer {
  private readonly beams = new Map<string, StoredBeams>();
  private readonly drawn: Segments;
  private capacity = 0;

  // Draws at most this number of beams.
  constructor(
    private readonly most: number,
    thin = false,
  ) {
    this.drawn = new Segments({ widthPx: WIDTH_PX, thin, opacity: OPACITY });
    this.grow(SMALLEST_CAPACITY);
  }

  get lines(): Segments["lines"] {
    return this.drawn.lines;
  }

  get segments(): number {
    return this.drawn.count;
  }

  // Sets the beams of one robot. They were measured when the robot was at `worldFromRobot`.
  setRobot({ robot, points, colours }: RobotBeams, worldFromRobot: Matrix4): void {
    if (points.length === 0) {
      this.beams.delete(robot);
      return;
    }
    const robotFromWorld = worldFromRobot.clone().invert();
    const pointsInRobot = new Float64Array(points.length);
    const point = new Vector3();
    for (let i = 0; i < points.length; i += NUMBERS_PER_POINT) {
      point.fromArray(points, i).applyMatrix4(robotFromWorld).toArray(pointsInRobot, i);
    }
    this.beams.set(robot, { pointsInRobot, colours });
  }

  keepOnly(robots: ReadonlySet<string>): void {
    for (const robot of [...this.beams.keys()]) if (!robots.has(robot)) this.beams.delete(robot);
  }

  // Moves the beams with the displayed robots. If there are too many beams, the beams of the robots
  // with the lowest `rank` are drawn.
  place(worldFromRobot: (robot: string) => Matrix4 | null, rank: (robot: string, frame: Matrix4) => number): void {
    const placed = [...this.beams].flatMap(([robot, beams]) => {
      const frame = worldFromRobot(robot);
      return frame ? [{ ...beams, frame, robot }] : [];
    });
    const chosen = this.chosen(placed, rank);
    const ends = chosen.reduce((sum, { pointsInRobot }) => sum + pointsInRobot.length / 3, 0);
    if (ends / 2 > this.capacity) this.grow(ends / 2);
    const point = new Vector3();
    let at = 0;
    for (const { frame, pointsInRobot, colours } of chosen) {
      this.drawn.colours.set(colours, at);
      for (let i = 0; i < pointsInRobot.length; i += 3) {
        point.fromArray(pointsInRobot, i).applyMatrix4(frame).toArray(this.drawn.positions, at);
        at += 3;
      }
    }
    this.drawn.upload(at / 6);
  }

  private chosen(placed: PlacedBeams[], rank: (robot: string, frame: Matrix4) => number): PlacedBeams[] {
    const count = (beams: readonly PlacedBeams[]) => beams.reduce((sum, { pointsInRobot }) => sum + pointsInRobot.length / 6, 0);
    if (count(placed) <= this.most) return placed;
    const ranked = placed.map((each) => ({ each, rank: rank(each.robot, each.frame) })).sort((a, b) => a.rank - b.rank);
    let left = this.most;
    return ranked.flatMap(({ each }) => ((left -= each.pointsInRobot.length / 6) >= 0 ? [each] : []));
  }

  dispose(): void {
    this.drawn.dispose();
  }

  private grow(segments: number): void {
    this.capacity = Math.max(SMALLEST_CAPACITY, 2 ** Math.ceil(Math.log2(segments)));
    this.drawn.allot(this.capacity);
  }
}
