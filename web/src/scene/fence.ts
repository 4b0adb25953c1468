// Finds out whether the graphics card, or the software that replaces it, has finished drawing.
import type { Fence } from "./RenderLoop";

export function fenceOf(gl: WebGL2RenderingContext): Fence {
  let sync: WebGLSync | null = null;
  const drop = () => {
    gl.deleteSync(sync);
    sync = null;
  };
  return {
    // Needs no gl.flush(): the browser sends the commands to the graphics when the frame ends.
    mark: () => {
      drop();
      sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    },
    // Also true if the WebGL context is lost, because nothing is drawn then.
    isReached: () => {
      if (sync !== null && gl.getSyncParameter(sync, gl.SYNC_STATUS) === gl.UNSIGNALED) return false;
      drop();
      return true;
    },
  };
}
