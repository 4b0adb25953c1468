// The parts of a displayed scene: bodies, lights, grid, sky.
import type { Box3, LineSegments, Scene } from "three";
import type { SceneDescription } from "../api/scene";
import { BodyLayer } from "./BodyLayer";
import { focusOf } from "./framing";
import { disposeGrid, makeGrid } from "./Ground";
import { LightRig } from "./LightRig";
import type { ModelLibrary } from "./ModelLibrary";
import { Sky } from "./Sky";

export interface ModelEvents {
  onMissing(count: number): void; // called with the number of models that are still being fetched
  onProblem(sentence: string): void;
}

export class SceneParts {
  readonly bodies: BodyLayer;
  readonly focus: Box3; // the part of the world that the first view shows
  readonly grid: LineSegments;
  readonly lights: LightRig;
  private readonly sky: Sky;
  private isGone = false;

  // If `hasEnvironment` is true, the environment map of `root` is the ambient light.
  constructor(description: SceneDescription, root: Scene, hasEnvironment: boolean) {
    this.bodies = new BodyLayer(description);
    this.focus = focusOf(description);
    this.lights = new LightRig(description, this.focus, hasEnvironment);
    this.grid = makeGrid(this.focus);
    this.sky = new Sky(description.look);
    root.add(this.sky.mesh, this.bodies.group, this.lights.group, this.grid);
  }

  // Fetches the models, and shows each model when it has arrived.
  load(library: ModelLibrary, events: ModelEvents): void {
    const links = new Map(this.bodies.scene.bodies.map((body) => [body.model, body.links]));
    let missing = links.size;
    events.onMissing(missing);
    for (const [id, linkNames] of links) {
      void library
        .get(id, linkNames)
        .then((template) => this.isGone || this.bodies.addModel(id, template))
        .catch((error: Error) => events.onProblem(error.message))
        .finally(() => {
          missing -= 1;
          if (!this.isGone) events.onMissing(missing);
        });
    }
  }

  dispose(): void {
    this.isGone = true;
    this.bodies.dispose();
    this.lights.dispose();
    disposeGrid(this.grid);
    this.sky.dispose();
  }
}
