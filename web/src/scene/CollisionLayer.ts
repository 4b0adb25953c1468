// Draws collision shapes as wireframes. If a robot is selected, only its shapes are drawn,
// otherwise the shapes of all bodies. The shapes are fetched when they are first needed.
import type { Group, Scene } from "three";
import { MeshBasicMaterial } from "three";
import type { SceneDescription } from "../api/scene";
import { BodyLayer } from "./BodyLayer";
import type { ModelLibrary } from "./ModelLibrary";
import type { ModelTemplate } from "./ModelTemplate";

const NET = new MeshBasicMaterial({ color: 0xff7a1a, wireframe: true, transparent: true, opacity: 0.55 });

export class CollisionLayer {
  private scene: SceneDescription | null = null;
  private selection: string | null = null;
  private isShown = false;
  private layer: BodyLayer | null = null;

  constructor(
    private readonly root: Scene,
    private readonly library: ModelLibrary,
    private readonly events: { onChange(): void; onProblem(sentence: string): void },
  ) {}

  // The shapes; null while they are hidden.
  get group(): Group | null {
    return this.layer?.group ?? null;
  }

  setScene(scene: SceneDescription | null): void {
    this.scene = scene;
    this.build();
  }

  select(robot: string | null): void {
    if (robot === this.selection) return;
    this.selection = robot;
    this.build();
  }

  show(isShown: boolean): void {
    if (isShown === this.isShown) return;
    this.isShown = isShown;
    this.build();
  }

  // Uses the displayed poses of the bodies.
  place(bodies: BodyLayer): void {
    this.layer?.standLike(bodies);
  }

  private build(): void {
    this.layer?.dispose();
    this.layer = null;
    if (!this.scene || !this.isShown) return;
    const layer = new BodyLayer(collisionScene(this.scene, this.selection));
    this.layer = layer;
    this.root.add(layer.group);
    const links = new Map(layer.scene.bodies.map((body) => [body.model, body.links]));
    links.delete("");
    for (const [id, names] of links) {
      this.library
        .get(id, names)
        .then((template) => {
          if (this.layer !== layer) return;
          layer.addModel(id, asNet(template));
          this.events.onChange();
        })
        .catch((error: Error) => this.events.onProblem(error.message));
    }
  }
}

// Returns a scene with the same bodies and poses. The models of the bodies are their collision
// shapes. Bodies that are not shown have no model.
export function collisionScene(scene: SceneDescription, selection: string | null): SceneDescription {
  const bodies = scene.bodies.map((body) => ({
    ...body,
    model: selection === null || body.name === selection ? (body.collisions ?? "") : "",
  }));
  return { ...scene, bodies };
}

function asNet(template: ModelTemplate): ModelTemplate {
  return { ...template, parts: template.parts.map((part) => ({ ...part, material: NET })) };
}
