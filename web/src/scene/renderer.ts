// The canvas of the 3D view and what draws on it.
import { NeutralToneMapping, PCFShadowMap, WebGLRenderer } from "three";

// `isFine`: edges are smoothed. Throws where the browser has no WebGL 2.
export function makeRenderer(isFine: boolean): WebGLRenderer {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-label", "The simulated world");
  canvas.setAttribute("role", "img");
  const renderer = new WebGLRenderer({ canvas, antialias: isFine, powerPreference: "high-performance" });
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}
