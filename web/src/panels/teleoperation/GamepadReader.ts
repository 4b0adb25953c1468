// Reads the first connected gamepad while the panel is visible. It must poll, because browsers send
// no events for sticks.
import type { Wish } from "./driving";
import { STILL, wishOfGamepad } from "./driving";

const READ_MS = 50;

interface Listener {
  onWish(wish: Wish): void;
  onConnected(name: string): void;
  onPulledOut(): void;
}

export class GamepadReader {
  private index: number | null = null; // index of the gamepad that is read

  constructor(
    private readonly listener: Listener,
    private readonly gamepads: () => readonly (Gamepad | null)[] = () => navigator.getGamepads?.() ?? [],
  ) {}

  // Reads until the returned function is called.
  open(): () => void {
    const clock = setInterval(() => this.read(), READ_MS);
    return () => {
      clearInterval(clock);
      this.index = null;
    };
  }

  read(): void {
    const connected = this.gamepads().filter((pad): pad is Gamepad => pad !== null && pad.connected);
    const pad = connected.find(({ index }) => index === this.index) ?? connected[0];
    if (this.index !== null && pad?.index !== this.index) {
      this.index = null;
      this.listener.onWish(STILL);
      this.listener.onPulledOut();
      return;
    }
    if (!pad) return;
    if (this.index === null) this.listener.onConnected(pad.id);
    this.index = pad.index;
    this.listener.onWish(wishOfGamepad(pad));
  }
}
