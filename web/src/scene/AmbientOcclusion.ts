// Draws ambient occlusion: darkens corners, and the ground below bodies, because less ambient light
// reaches them. The method is "Scalable Ambient Obscurance" (McGuire, Mara, Luebke 2012). The
// depths of the bodies are drawn once more at half the resolution, and each pixel is compared with
// some pixels around it. The result is smoothed, and the image is multiplied by it.
import type { Matrix4, PerspectiveCamera, Scene, Texture, WebGLRenderer } from "three";
import {
  CustomBlending,
  DepthTexture,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  NoBlending,
  OrthographicCamera,
  PlaneGeometry,
  Scene as PassScene,
  ShaderMaterial,
  SrcColorFactor,
  Vector2,
  WebGLRenderTarget,
  ZeroFactor,
} from "three";

// Ambient occlusion is computed from the depths of the objects on this layer.
export const OCCLUDING_LAYER = 1;

const RADIUS = 0.25; // m: surfaces within this distance of a point darken the point
const STRENGTH = 0.06; // m
const DARKEST = 0.45;
const SAMPLES = 12;

const VERTEX = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

// Returns the position of a pixel in the camera's frame, from its depth.
const PLACE = `
uniform sampler2D depths;
uniform mat4 viewFromClip;
vec3 placeAt(vec2 uv) {
  vec4 place = viewFromClip * vec4(2.0 * vec3(uv, texture2D(depths, uv).r) - 1.0, 1.0);
  return place.xyz / place.w;
}`;

const OCCLUSION = `
varying vec2 at;
uniform vec2 size; // pixels
uniform float pixelsPerMetre; // at a distance of 1 m
${PLACE}
void main() {
  if (texture2D(depths, at).r >= 1.0) {
    gl_FragColor = vec4(1.0);
    return;
  }
  vec3 place = placeAt(at);
  vec2 pixel = 1.0 / size;
  // The normal is computed from the differences in depth to the neighbouring pixels: one of left
  // and right, and one of up and down. The smaller difference is used, because the larger one may
  // reach across an edge to another surface.
  vec3 right = placeAt(at + vec2(pixel.x, 0.0)) - place;
  vec3 left = place - placeAt(at - vec2(pixel.x, 0.0));
  vec3 up = placeAt(at + vec2(0.0, pixel.y)) - place;
  vec3 down = place - placeAt(at - vec2(0.0, pixel.y));
  vec3 normal = normalize(cross(abs(right.z) < abs(left.z) ? right : left, abs(up.z) < abs(down.z) ? up : down));
  float reach = min(pixelsPerMetre * ${RADIUS.toFixed(3)} / -place.z, 0.25 * size.y);
  float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float sum = 0.0;
  for (int i = 0; i < ${SAMPLES}; i++) {
    float part = (float(i) + 0.5) / ${SAMPLES}.0;
    float angle = turn + 2.3999632 * float(i);
    vec3 other = placeAt(at + pixel * reach * part * vec2(cos(angle), sin(angle))) - place;
    float squared = dot(other, other);
    // Ignores differences that are due to the rounding of depths.
    float height = dot(other, normal) - 0.002 * -place.z;
    float near = max(0.0, ${(RADIUS * RADIUS).toFixed(4)} - squared);
    sum += near * near * near * max(0.0, height / (squared + 0.0001));
  }
  float taken = ${(5 * STRENGTH / (RADIUS ** 6 * SAMPLES)).toFixed(2)} * sum;
  gl_FragColor = vec4(vec3(max(${DARKEST.toFixed(2)}, 1.0 - taken)), 1.0);
}`;

// Returns the mean of the surrounding pixels with a similar depth.
const SMOOTH = `
varying vec2 at;
uniform vec2 size;
uniform sampler2D occlusion;
${PLACE}
void main() {
  float depth = placeAt(at).z;
  float sum = 0.0;
  float weights = 0.0;
  for (int x = -2; x <= 2; x++) {
    for (int y = -2; y <= 2; y++) {
      vec2 uv = at + vec2(float(x), float(y)) / size;
      float weight = max(0.0, 1.0 - abs(placeAt(uv).z - depth) / (0.02 * -depth)) + 0.0001;
      sum += weight * texture2D(occlusion, uv).r;
      weights += weight;
    }
  }
  gl_FragColor = vec4(vec3(sum / weights), 1.0);
}`;

export class AmbientOcclusion {
  private readonly depths = new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter, depthTexture: new DepthTexture(1, 1) });
  private readonly occlusion = new WebGLRenderTarget(1, 1, { depthBuffer: false });
  private readonly size = new Vector2();
  private readonly plain = new MeshBasicMaterial({ colorWrite: false });
  private readonly measure = this.pass(OCCLUSION, { pixelsPerMetre: { value: 1 } });
  private readonly smooth = this.pass(SMOOTH, { occlusion: { value: this.occlusion.texture } });
  private readonly quad = new Mesh(new PlaneGeometry(2, 2), this.measure);
  private readonly quads = new PassScene().add(this.quad);
  private readonly flat = new OrthographicCamera();

  constructor(private readonly renderer: WebGLRenderer) {
    this.quad.frustumCulled = false;
    Object.assign(this.smooth, { blending: CustomBlending, blendSrc: ZeroFactor, blendDst: SrcColorFactor, blendSrcAlpha: ZeroFactor });
  }

  // Darkens the image of the scene that was just drawn.
  darken(scene: Scene, camera: PerspectiveCamera): void {
    const { renderer, size } = this;
    renderer.getDrawingBufferSize(size).multiplyScalar(0.5).ceil();
    for (const target of [this.depths, this.occlusion]) target.setSize(size.x, size.y);
    this.drawDepths(scene, camera);
    this.measure.uniforms.pixelsPerMetre!.value = size.y / 2 / Math.tan((camera.fov * Math.PI) / 360);
    const { autoClear } = renderer;
    renderer.autoClear = false;
    this.draw(this.measure, camera, this.occlusion);
    this.draw(this.smooth, camera, null);
    renderer.autoClear = autoClear;
  }

  dispose(): void {
    for (const each of [this.depths, this.occlusion, this.plain, this.measure, this.smooth, this.quad.geometry]) each.dispose();
  }

  private drawDepths(scene: Scene, camera: PerspectiveCamera): void {
    const { mask } = camera.layers;
    const { background, overrideMaterial } = scene;
    camera.layers.set(OCCLUDING_LAYER);
    scene.background = null;
    scene.overrideMaterial = this.plain;
    this.renderer.setRenderTarget(this.depths);
    this.renderer.render(scene, camera);
    this.renderer.setRenderTarget(null);
    Object.assign(scene, { background, overrideMaterial });
    camera.layers.mask = mask;
  }

  private draw(material: ShaderMaterial, camera: PerspectiveCamera, target: WebGLRenderTarget | null): void {
    const { viewFromClip, size, depths } = material.uniforms as { viewFromClip: { value: Matrix4 }; size: { value: Vector2 }; depths: { value: Texture | null } };
    viewFromClip.value = camera.projectionMatrixInverse;
    size.value = this.size;
    depths.value = this.depths.depthTexture;
    this.quad.material = material;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.quads, this.flat);
    this.renderer.setRenderTarget(null);
  }

  private pass(fragmentShader: string, uniforms: ShaderMaterial["uniforms"]): ShaderMaterial {
    const common = { depths: { value: null }, viewFromClip: { value: null }, size: { value: null } };
    const look = { depthTest: false, depthWrite: false, blending: NoBlending, toneMapped: false };
    return new ShaderMaterial({ vertexShader: VERTEX, fragmentShader, uniforms: { ...common, ...uniforms }, ...look });
  }
}
