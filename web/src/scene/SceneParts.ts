// The parts of a displayed scene: bodies, lights, grid, sky.
import type { Box3, Group, LineSegments, Scene } from "three";
import type { SceneDescription } from "../api/scene";
import { BodyLayer } from "./BodyLayer";
import { focusOf } from "./framing";
import { disposeGrid, makeGrid } from "./Ground";
import { disposeLights, makeLights } from "./LightRig";
import type { ModelLibrary } from "./ModelLibrary";
import { Sky } from "./Sky";

export interface ModelEvents {
  onMissing(count: number): void; // that are still being fetched
  onProblem(sentence: string): void;
}

export class SceneParts {
  readonly bodies: BodyLayer;
  readonly focus: Box3; // what one looks at first
  readonly grid: LineSegments;
  private readonly lights: Group;
  private readonly sky: Sky;
  private isGone = false;

  constructor(description: SceneDescription, root: Scene) {
    this.bodies = new BodyLayer(description);
    this.focus = focusOf(description);
    this.lights = makeLights(description, this.focus);
    this.grid = makeGrid(this.focus);
    this.sky = new Sky(description.look);
    root.add(this.sky.mesh, this.bodies.group, this.lights, this.grid);
  }

  // Fetches the models, and shows each when it has arrived.
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
    disposeLights(this.lights);
    disposeGrid(this.grid);
    this.sky.dispose();
  }
}
