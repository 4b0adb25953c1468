// Whether the browser draws in software, according to the renderer's name. Null without WebGL 2.
export function drawsInSoftware(canvas: HTMLCanvasElement | OffscreenCanvas): boolean | null {
  const gl = canvas.getContext("webgl2") as WebGL2RenderingContext | null;
  if (!gl) return null;
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer: unknown = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : "";
  // Releases the context.
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(String(renderer));
}
