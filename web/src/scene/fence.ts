// Tells when the graphics card, or what stands for it, has drawn what it was told to.
import type { Fence } from "./RenderLoop";

export function fenceOf(gl: WebGL2RenderingContext): Fence {
  let sync: WebGLSync | null = null;
  const drop = () => {
    gl.deleteSync(sync);
    sync = null;
  };
  return {
    mark: () => {
      drop();
      sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl.flush();
    },
    // Also where the context was lost: nothing is drawn there any more.
    isReached: () => {
      if (sync !== null && gl.getSyncParameter(sync, gl.SYNC_STATUS) === gl.UNSIGNALED) return false;
      drop();
      return true;
    },
  };
}
