// Canvases for tests. Each character of a text is half as wide as the font's size.
import { vi } from "vitest";

export interface DrawnText {
  text: string;
  font: string;
}

export interface TestCanvas {
  texts: DrawnText[]; // texts that were drawn on any canvas
  copies: number[][]; // arguments of drawImage, after the image
  restore(): void;
}

// Replaces the contexts of all canvases until restore().
export function useTestCanvas(): TestCanvas {
  const texts: DrawnText[] = [];
  const copies: number[][] = [];
  const spy = vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockImplementation(function (this: HTMLCanvasElement) {
    const context = {
      canvas: this,
      font: "",
      measureText(text: string) {
        const size = Number(/([\d.]+)px/.exec(context.font)?.[1]);
        return { width: (size / 2) * text.length, fontBoundingBoxAscent: size, fontBoundingBoxDescent: size / 4 };
      },
      fillText: (text: string) => texts.push({ text, font: context.font }),
      drawImage: (_: unknown, ...numbers: number[]) => copies.push(numbers),
    };
    for (const name of ["beginPath", "roundRect", "fill", "stroke", "clearRect"]) Object.assign(context, { [name]: () => {} });
    return context as unknown as CanvasRenderingContext2D;
  } as never);
  return { texts, copies, restore: () => spy.mockRestore() };
}
