// Draws one label with the look that the style sheet defines for the class `label`.

export const LABEL_HEIGHT = 18; // in CSS pixels, as all sizes here
const TEXT_SIZE = 11.5;
const PADDING = 6; // on both sides of the text
const RADIUS = 5;
const EDGE = 1.5;
const MAX_TEXT_WIDTH = 320; // the middle of a longer name is replaced by an ellipsis
const CHARACTER_WIDTH = 7; // used if the browser does not return the width of a text

// The CSS classes of a label.
export type LabelKind = "label" | "label selected" | "label trouble" | "label selected trouble";

interface Look {
  ground: string;
  ink: string;
  edge: string;
  font: string; // with %size% instead of the size
}

type Context = CanvasRenderingContext2D;

export class LabelPainter {
  private readonly looks = new Map<LabelKind, Look>();
  private readonly sample = document.createElement("span");
  private measuring: Context | null | undefined;

  // The computed style of a hidden element in `parent` is the look of the labels.
  constructor(parent: HTMLElement) {
    this.sample.hidden = true;
    parent.append(this.sample);
  }

  // Call this when the style of the page has changed.
  renew(): void {
    this.looks.clear();
  }

  // Returns the width of a label in device pixels. `ratio` is the number of device pixels for a CSS
  // pixel.
  widthOf(name: string, ratio: number): number {
    return 2 * Math.round(PADDING * ratio) + Math.ceil(Math.min(MAX_TEXT_WIDTH * ratio, this.textWidth(name, ratio)));
  }

  // Draws a label. `left`, `top` and `width` are in device pixels.
  paint(context: Context, name: string, kind: LabelKind, left: number, top: number, width: number, ratio: number): void {
    const look = this.lookOf(kind);
    const height = heightOf(ratio);
    context.beginPath();
    context.roundRect(left, top, width, height, RADIUS * ratio);
    context.fillStyle = look.ground;
    context.fill();
    if (kind.includes("trouble")) {
      const line = EDGE * ratio;
      context.beginPath();
      context.roundRect(left + line / 2, top + line / 2, width - line, height - line, RADIUS * ratio - line / 2);
      context.lineWidth = line;
      context.strokeStyle = look.edge;
      context.stroke();
    }
    context.font = fontOf(look, ratio);
    context.textBaseline = "alphabetic";
    context.fillStyle = look.ink;
    const { fontBoundingBoxAscent: ascent, fontBoundingBoxDescent: descent } = context.measureText(name);
    // On a whole pixel, so that horizontal strokes are sharp.
    const baseline = Math.round((height + ascent - descent) / 2);
    context.fillText(this.shortened(name, ratio), left + Math.round(PADDING * ratio), top + baseline);
  }

  // Returns the name, or its beginning and end if it is too long.
  private shortened(name: string, ratio: number): string {
    const characters = [...name];
    let shown = name;
    for (let kept = characters.length - 1; kept > 0 && this.textWidth(shown, ratio) > MAX_TEXT_WIDTH * ratio; kept--) {
      shown = `${characters.slice(0, Math.ceil(kept / 2)).join("")}…${characters.slice(characters.length - Math.floor(kept / 2)).join("")}`;
    }
    return shown;
  }

  private textWidth(text: string, ratio: number): number {
    this.measuring ??= document.createElement("canvas").getContext("2d");
    if (!this.measuring) return CHARACTER_WIDTH * ratio * text.length;
    this.measuring.font = fontOf(this.lookOf("label"), ratio);
    return this.measuring.measureText(text).width;
  }

  private lookOf(kind: LabelKind): Look {
    let look = this.looks.get(kind);
    if (look) return look;
    this.sample.className = kind;
    const { backgroundColor, color, borderTopColor, fontFamily, fontWeight } = getComputedStyle(this.sample);
    look = { ground: backgroundColor, ink: color, edge: borderTopColor, font: `${fontWeight} %size% ${fontFamily}` };
    this.looks.set(kind, look);
    return look;
  }
}

// Returns the height of a label in device pixels.
export function heightOf(ratio: number): number {
  return Math.round(LABEL_HEIGHT * ratio);
}

function fontOf({ font }: Look, ratio: number): string {
  return font.replace("%size%", `${TEXT_SIZE * ratio}px`);
}
