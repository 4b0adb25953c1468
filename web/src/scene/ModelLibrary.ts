// Fetches models by ID, each model once. Keeps the models that the present scene uses.
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { SceneDescription } from "../api/scene";
import { LightMaps } from "./LightMaps";
import type { ModelTemplate } from "./ModelTemplate";
import { disposeTemplate, makeTemplate } from "./ModelTemplate";

export class ModelLibrary {
  private readonly loader = new GLTFLoader().register((parser) => new LightMaps(parser));
  private readonly templates = new Map<string, Promise<ModelTemplate>>();

  constructor(
    private readonly urlOf: (id: string) => string,
    private readonly headers: () => Record<string, string> = () => ({}),
  ) {}

  // Returns a model. If it cannot be fetched, throws an error with a message for the user, and a
  // later call tries again.
  get(id: string, links: readonly string[]): Promise<ModelTemplate> {
    let template = this.templates.get(id);
    if (!template) {
      template = this.fetch(id, links);
      this.templates.set(id, template);
      template.catch(() => this.templates.delete(id));
    }
    return template;
  }

  // Starts to fetch the models of a scene. Only get() reports errors.
  prepare({ bodies }: SceneDescription): void {
    for (const { model, links } of bodies) this.get(model, links).catch(() => {});
  }

  // Releases all models that are not in `ids`.
  keepOnly(ids: ReadonlySet<string>): void {
    for (const [id, template] of [...this.templates]) {
      if (ids.has(id)) continue;
      this.templates.delete(id);
      template.then(disposeTemplate).catch(() => {});
    }
  }

  private async fetch(id: string, links: readonly string[]): Promise<ModelTemplate> {
    try {
      this.loader.setRequestHeader(this.headers());
      const { scene } = await this.loader.loadAsync(this.urlOf(id));
      return makeTemplate(scene, links);
    } catch (error) {
      throw new Error(`The shape of model ${id} cannot be shown: ${(error as Error).message}`);
    }
  }
}
