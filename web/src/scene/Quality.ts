// Keeps the frame rate up if drawing is slow, for example without a graphics card. First omits
// ambient occlusion, and then reduces the number of pixels. Increases the number again when drawing
// is fast enough.

const SLOW_MS = 55;
const VERY_SLOW_MS = 200; // a frame of this length counts as several slow frames
const FAST_MS = 20;
const PATIENCE = 12; // number of slow frames in a row
const LOWEST = 0.6;
const HIGHEST_DEVICE_RATIO = 2;

export class Quality {
  private scale = 1;
  private slow = 0;
  private fast = 0;

  // If `isRich` is true, ambient occlusion is on at first.
  constructor(
    private readonly deviceRatio: number,
    private readonly fixed: boolean,
    private isRich = false,
  ) {}

  // Whether ambient occlusion is drawn. If it was too slow once, it stays off.
  get hasOcclusion(): boolean {
    return this.isRich;
  }

  // The number of device pixels per CSS pixel.
  get pixelRatio(): number {
    return Math.min(HIGHEST_DEVICE_RATIO, this.deviceRatio) * this.scale;
  }

  // Takes the time that a frame has taken. Returns true if this changes the quality of the
  // next frame.
  frameTook(milliseconds: number): boolean {
    if (this.fixed) return false;
    this.slow = milliseconds > SLOW_MS ? this.slow + (milliseconds > VERY_SLOW_MS ? 4 : 1) : 0;
    this.fast = milliseconds < FAST_MS ? this.fast + 1 : 0;
    if (this.slow >= PATIENCE && this.isRich) return this.omitOcclusion();
    if (this.slow >= PATIENCE && this.scale > LOWEST) return this.rescale(this.scale * 0.8);
    if (this.fast >= 10 * PATIENCE && this.scale < 1) return this.rescale(this.scale * 1.25);
    return false;
  }

  private omitOcclusion(): boolean {
    this.isRich = false;
    this.slow = this.fast = 0;
    return true;
  }

  private rescale(scale: number): boolean {
    this.scale = Math.min(1, Math.max(LOWEST, scale));
    this.slow = this.fast = 0;
    return true;
  }
}
