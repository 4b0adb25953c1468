// Images and videos of the view.

const PICTURES_PER_SECOND = 30;

// Captures a canvas. It must have been drawn in this task, because the browser clears it
// afterwards. `paint` draws on the image.
export async function pngOf(
  canvas: HTMLCanvasElement,
  paint: (context: CanvasRenderingContext2D) => void,
): Promise<Blob> {
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d");
  if (!context) throw new Error("This browser cannot save an image of the view.");
  context.drawImage(canvas, 0, 0);
  paint(context);
  return new Promise((resolve, reject) => {
    copy.toBlob((blob) => {
      if (blob) resolve(blob);
      else reject(new Error("This browser cannot save an image of the view."));
    }, "image/png");
  });
}

export function videoOf(canvas: HTMLCanvasElement): MediaStream {
  return canvas.captureStream(PICTURES_PER_SECOND);
}
