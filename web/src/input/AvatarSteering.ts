// Drives an avatar while keys are held. Sends a command at each change, and repeats it while keys
// are held. When the keys are released, sends a command to stop.
import type { Drive } from "../api/SimulationApi";
import { isSingleKey, isTyping } from "./Keyboard";

const SPEED_M_S = 0.8;
const TURN_RAD_S = 1.4;
const HASTE = 2;
const REPEAT_MS = 150;

export const STANDING: Drive = { linear_m_s: 0, lateral_m_s: 0, angular_rad_s: 0 };

const FORWARD = ["w", "arrowup"];
const BACK = ["s", "arrowdown"];
const TURN_LEFT = ["a", "arrowleft"];
const TURN_RIGHT = ["d", "arrowright"];
const LEFT = ["q"];
const RIGHT = ["e"];
const DRIVING_KEYS = [FORWARD, BACK, TURN_LEFT, TURN_RIGHT, LEFT, RIGHT].flat();

// Returns the motion for the pressed keys (lower case). Opposite keys cancel each other.
export function driveOf(held: ReadonlySet<string>): Drive {
  const any = (keys: string[]) => (keys.some((key) => held.has(key)) ? 1 : 0);
  const haste = held.has("shift") ? HASTE : 1;
  return {
    linear_m_s: (any(FORWARD) - any(BACK)) * SPEED_M_S * haste,
    lateral_m_s: (any(LEFT) - any(RIGHT)) * SPEED_M_S * haste,
    angular_rad_s: (any(TURN_LEFT) - any(TURN_RIGHT)) * TURN_RAD_S,
  };
}

export class AvatarSteering {
  private readonly held = new Set<string>();
  private timer: ReturnType<typeof setInterval> | undefined;
  private sending = false;
  private unsent: Drive | null = null;
  private told: Drive = STANDING;

  // `avatar` returns the name of the avatar to drive, or null. `send` may fail; it reports failures
  // itself. If `hearsSingleKeys` is true, letters also drive, and not only arrow keys.
  constructor(
    private readonly avatar: () => string | null,
    private readonly send: (avatar: string, drive: Drive) => Promise<void>,
    private readonly hearsSingleKeys: () => boolean = () => true,
  ) {}

  listen(target: Window): void {
    target.addEventListener("keydown", (event) => this.keyDown(event));
    target.addEventListener("keyup", (event) => this.keyUp(event.key));
    target.addEventListener("blur", () => this.letGo());
  }

  keyDown(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.altKey || event.metaKey || isTyping(event.target)) return;
    if (isSingleKey(event) && !this.hearsSingleKeys()) return;
    if (key === "shift") this.held.add(key);
    if (!DRIVING_KEYS.includes(key) || this.avatar() === null) return;
    event.preventDefault();
    this.held.add(key);
    this.tell(driveOf(this.held));
    this.timer ??= setInterval(() => this.tell(driveOf(this.held), true), REPEAT_MS);
  }

  keyUp(key: string): void {
    if (!this.held.delete(key.toLowerCase())) return;
    if (DRIVING_KEYS.some((each) => this.held.has(each))) this.tell(driveOf(this.held));
    else this.letGo();
  }

  private letGo(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.held.clear();
    this.tell(STANDING);
  }

  private tell(drive: Drive, repeat = false): void {
    const isNews =
      drive.linear_m_s !== this.told.linear_m_s ||
      drive.lateral_m_s !== this.told.lateral_m_s ||
      drive.angular_rad_s !== this.told.angular_rad_s;
    if (!isNews && !repeat) return;
    this.told = drive;
    this.unsent = drive;
    if (!this.sending) void this.sendAll();
  }

  // Sends one command at a time. Of the commands that are made meanwhile, only the newest is sent.
  private async sendAll(): Promise<void> {
    this.sending = true;
    while (this.unsent) {
      const drive = this.unsent;
      this.unsent = null;
      const avatar = this.avatar();
      if (avatar !== null) await this.send(avatar, drive);
    }
    this.sending = false;
  }
}
