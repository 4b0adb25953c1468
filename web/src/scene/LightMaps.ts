// Reads the light maps of materials: glTF's extension MOZ_lightmap.
import { SRGBColorSpace } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/addons/loaders/GLTFLoader.js";

const NAME = "MOZ_lightmap";

export class LightMaps implements GLTFLoaderPlugin {
  readonly name = NAME;

  constructor(private readonly parser: GLTFParser) {}

  // three.js treats a light map as irradiance and divides it by π. With the factor π, a surface
  // reflects its diffuse colour times the light map, as in Gazebo and in the robots' cameras.
  async extendMaterialParams(material: number, parameters: { [key: string]: unknown }): Promise<void> {
    const given = this.parser.json.materials[material]?.extensions?.[NAME] as { index: number; intensity?: number } | undefined;
    if (!given) return;
    parameters.lightMapIntensity = Math.PI * (given.intensity ?? 1);
    await this.parser.assignTexture(parameters, "lightMap", given, SRGBColorSpace);
  }
}
