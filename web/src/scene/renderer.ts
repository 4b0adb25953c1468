// The canvas of the 3D view and what draws on it.
import { NeutralToneMapping, PCFShadowMap, WebGLRenderer } from "three";

// `isFine`: edges are smoothed. Throws where the browser has no WebGL 2.
export function makeRenderer(isFine: boolean): WebGLRenderer {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-label", "The simulated world");
  canvas.setAttribute("role", "img");
  // Opaque: nothing of the page shows through.
  const context = canvas.getContext("webgl2", {
    alpha: false,
    antialias: isFine,
    powerPreference: "high-performance",
  });
  if (!context) throw new Error("this browser does not support WebGL 2");
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}
