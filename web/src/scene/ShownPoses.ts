// The poses with which a scene is displayed: receives the stream's messages and provides poses for
// every frame.
import type { Matrix4 } from "three";
import type { PosesMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import type { BodyLayer } from "./BodyLayer";
import { matrixOf } from "./BodyFrames";
import type { PoseSample } from "./PoseInterpolator";
import { PoseInterpolator } from "./PoseInterpolator";

export class ShownPoses {
  private readonly interpolator = new PoseInterpolator();
  private bodies: BodyLayer | null = null;
  private shown = new Float64Array(0);
  private last: PosesMessage | null = null;

  // `onSample` receives the poses of the scene.
  constructor(private readonly onSample: (sample: PoseSample) => void) {}

  // Sets another scene or none, and clears the previous poses. Poses may arrive before their scene.
  setScene(bodies: BodyLayer | null): void {
    this.interpolator.clear();
    this.bodies = bodies;
    this.shown = new Float64Array(7 * (bodies?.scene.poses.length ?? 0));
    if (!bodies) this.last = null;
    if (this.last) this.take(this.last);
  }

  take(message: PosesMessage): void {
    this.last = message;
    if (!this.bodies || this.bodies.scene.layoutVersion !== message.layout_version) return;
    if (message.poses.length !== this.shown.length) return;
    const sample = { step: Number(message.step), stamp: seconds(message.stamp), poses: message.poses };
    this.interpolator.push(sample, performance.now());
    this.onSample(sample);
  }

  // Sets the displayed poses of the bodies. Returns false if none are known.
  show(nowMs: number): boolean {
    if (!this.bodies || !this.interpolator.read(nowMs, this.shown)) return false;
    this.bodies.setPoses(this.shown);
    return true;
  }

  // Like show(), but with the poses at a simulated time in seconds. If the server draws the view,
  // this is the time of its image, so that labels and marks lie at the right places in the image.
  showAt(stamp: number): boolean {
    if (!this.bodies || !this.interpolator.readAt(stamp, this.shown)) return false;
    this.bodies.setPoses(this.shown);
    return true;
  }

  isSettled(nowMs: number): boolean {
    return this.interpolator.isSettled(nowMs);
  }

  // Returns the poses at this simulated instant. If they are not known any more, returns the newest
  // poses.
  at(stamp: number): Float64Array | null {
    return this.interpolator.at(stamp) ?? this.interpolator.latest?.poses ?? null;
  }

  // Returns the last reported pose of a body (world_from_body), with its simulated time; null while
  // unknown.
  latestOf(body: string): { pose: Matrix4; stamp: number } | null {
    const { latest } = this.interpolator;
    const entry = this.bodies?.poseEntryOf(body) ?? null;
    if (!latest || entry === null) return null;
    return { pose: matrixOf(latest.poses, 7 * entry), stamp: latest.stamp };
  }

  // Like latestOf(), but also for bodies that have no entry in the poses' messages: returns their
  // pose in the scene. While the user drags a body, the returned pose does not change.
  reportedOf(body: string): Matrix4 | null {
    const index = this.bodies?.indexOf(body) ?? -1;
    const inScene = this.bodies?.scene.bodies[index]?.pose;
    return this.latestOf(body)?.pose ?? (inScene ? matrixOf(inScene) : null);
  }
}
