// The background. It is darker above and below than at the horizon, as in the robots' cameras
// (gsv/rendering). Below the horizon, it is less dark than in their images, like haze, because the
// camera often looks down over the edge of the ground. The background moves with the camera, so
// that it is always far away.
import type { OrthographicCamera, PerspectiveCamera } from "three";
import { BackSide, Color, Float32BufferAttribute, Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import type { SceneDescription } from "../api/scene";
import { colourOf } from "./LightRig";

const HAZE_BELOW = 0.3;
const SKY = {
  zenith: new Color(0.12, 0.28, 0.62),
  horizon: new Color(0.62, 0.74, 0.86),
  nadir: new Color(0.3, 0.29, 0.27),
};

export class Sky {
  readonly mesh: Mesh;
  private readonly geometry = new SphereGeometry(1, 24, 32).rotateX(Math.PI / 2);
  private readonly material = new MeshBasicMaterial({
    side: BackSide,
    vertexColors: true,
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    fog: false,
  });

  constructor(look: SceneDescription["look"]) {
    this.paint(shadesOfSky(look.sky ? null : colourOf(look.background)));
    this.mesh = new Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
    this.mesh.raycast = () => {};
    this.mesh.onBeforeRender = (_renderer, _scene, camera) => this.stayAround(camera as PerspectiveCamera | OrthographicCamera);
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
    this.mesh.removeFromParent();
  }

  private paint({ zenith, horizon, nadir }: typeof SKY): void {
    const positions = this.geometry.getAttribute("position");
    const colours = new Float32Array(3 * positions.count);
    const colour = new Color();
    for (let i = 0; i < positions.count; i++) {
      const z = positions.getZ(i);
      const share = Math.sqrt(Math.abs(z));
      if (z > 0) colour.lerpColors(horizon, zenith, share);
      else colour.lerpColors(horizon, nadir, HAZE_BELOW * share);
      colour.toArray(colours, 3 * i);
    }
    this.geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
  }

  // Moves the sky to the middle of the drawn depths. This is needed for a map, whose depths begin
  // many metres away from its camera.
  private stayAround(camera: PerspectiveCamera | OrthographicCamera): void {
    const radius = (camera.near + camera.far) / 2;
    const [x, y, z] = camera.matrixWorld.elements.slice(12) as [number, number, number];
    this.mesh.matrixWorld.makeScale(radius, radius, radius).setPosition(x, y, z);
    this.mesh.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, this.mesh.matrixWorld);
  }
}

// Returns the colours of the sky. `background` is the colour of a world without a sky.
export function shadesOfSky(background: Color | null): typeof SKY {
  if (!background) return SKY;
  return {
    zenith: background.clone().multiplyScalar(0.8),
    horizon: background.clone().lerp(new Color(1, 1, 1), 0.08),
    nadir: background.clone().multiplyScalar(0.7),
  };
}
