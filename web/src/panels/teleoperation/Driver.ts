// Drives one robot at a time. Sends a command when it changes, repeats it while it applies, and
// stops the robot when there is no input. After a refusal, sends nothing until all inputs are
// released.
import { NewestOnly } from "../../api/NewestOnly";
import type { Drive } from "../../api/SimulationApi";
import type { Speeds, Wish } from "./driving";
import { STILL, driveOf, isStill } from "./driving";

const REPEAT_MS = 150;

interface Order {
  robot: string;
  drive: Drive;
}

export class Driver {
  private readonly orders: NewestOnly<Order>;
  private robot: string | null = null;
  private wish: Wish = STILL;
  private speeds: Speeds = { linear: 0, angular: 0 };
  private isRefused = false;
  private timer: ReturnType<typeof setInterval> | undefined;

  // `onProblem` gets the server's sentence after a refusal.
  constructor(
    send: (robot: string, drive: Drive) => Promise<void>,
    private readonly onProblem: (sentence: string) => void,
  ) {
    this.orders = new NewestOnly(
      ({ robot, drive }) => send(robot, drive),
      (sentence) => this.refuse(sentence),
    );
  }

  get isDriving(): boolean {
    return this.timer !== undefined;
  }

  // Selects the robot to drive. Call stop() first: this function does not stop the previous robot.
  setRobot(robot: string | null): void {
    this.robot = robot;
  }

  move(wish: Wish, speeds: Speeds): void {
    if (isStill(wish)) return this.stop();
    if (this.isRefused || this.robot === null) return;
    const isNews = JSON.stringify([wish, speeds]) !== JSON.stringify([this.wish, this.speeds]);
    [this.wish, this.speeds] = [wish, speeds];
    this.timer ??= setInterval(() => this.send(), REPEAT_MS);
    if (isNews) this.send();
  }

  stop(): void {
    this.isRefused = false;
    if (this.timer === undefined) return;
    this.halt();
    this.send();
  }

  private halt(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.wish = STILL;
  }

  private refuse(sentence: string): void {
    this.halt();
    this.isRefused = true;
    this.onProblem(sentence);
  }

  private send(): void {
    if (this.robot !== null) this.orders.push({ robot: this.robot, drive: driveOf(this.wish, this.speeds) });
  }
}
