// The canvas of the 3D view and its renderer.
import { NeutralToneMapping, PCFShadowMap, WebGLRenderer } from "three";

// The functions of a renderer that the view uses.
export type ViewRenderer = Pick<
  WebGLRenderer,
  "domElement" | "render" | "setSize" | "setPixelRatio" | "getPixelRatio"
> & { shadowMap: Pick<WebGLRenderer["shadowMap"], "needsUpdate"> };

// A canvas that only receives the pointer, for use while the server draws the view.
export function makeBareRenderer(): ViewRenderer {
  return {
    domElement: makeCanvas(),
    shadowMap: { needsUpdate: false },
    render: () => {},
    setPixelRatio: () => {},
    getPixelRatio: () => 1,
    setSize(width: number, height: number) {
      this.domElement.style.width = `${width}px`;
      this.domElement.style.height = `${height}px`;
    },
  };
}

function makeCanvas(): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("aria-label", "The simulated world");
  canvas.setAttribute("role", "img");
  return canvas;
}

// If `isFine` is true, the renderer uses antialiasing. Returns null if the browser has no WebGL 2.
export function makeRenderer(isFine: boolean): WebGLRenderer | null {
  const canvas = makeCanvas();
  // The canvas is opaque, so that the page behind it is hidden.
  const context = canvas.getContext("webgl2", {
    alpha: false,
    antialias: isFine,
    powerPreference: "high-performance",
  });
  if (!context) return null;
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}
