// The state of each robot, as the server computes it from commands and motion (docs/viewer.md).
import type { RobotStatus } from "../api/status";
import type { HealthMessage, RobotHealthMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import { formatNumber } from "../ui/format";

// The states that the server reports, and two states of the page; the worst state is first. `told`
// means that the robot was commanded to move and does not move, but not yet for so long that the
// server reports `stuck`. `unknown` means that no state is reported.
export const SHOWN_STATES = ["dead", "stuck", "contact", "late", "told", "standing", "unknown", "moving"] as const;
export type ShownState = (typeof SHOWN_STATES)[number];

export const STATE_WORDS: Record<ShownState, string> = {
  dead: "dead",
  stuck: "stuck",
  contact: "in contact",
  late: "late",
  told: "commanded to move, but standing",
  standing: "standing",
  unknown: "unknown",
  moving: "moving",
};

export interface RobotHealth {
  robot: string;
  state: ShownState;
  level: number; // 0: fine, 1: warning, 2: error
  since: number; // s, simulated
  command: { linear: number; lateral: number; angular: number }; // the last command, m/s and rad/s
  actual: { linear: number; angular: number };
  // the range sensor with the shortest distance below 1 m; null if there is none
  limit: { sensor: string; value: number; unit: string } | null;
  contact: string; // the body that the robot touches
  summary: string; // such as "has not moved"
  reason: string; // such as "commanded 0, sonar_00 reads 0.26 m"; empty if there is none
}

export interface Health {
  time: number; // s, simulated
  stuckAfter: number; // s
  robots: ReadonlyMap<string, RobotHealth>; // by name; moving robots are left out
}

export function healthOf(message: HealthMessage): Health {
  return {
    time: seconds(message.stamp),
    stuckAfter: message.stuck_after_s,
    robots: new Map(message.robots.map((robot) => [robot.robot, robotHealthOf(robot)])),
  };
}

function robotHealthOf(message: RobotHealthMessage): RobotHealth {
  const command = {
    linear: message.command_linear_m_s,
    lateral: message.command_lateral_m_s,
    angular: message.command_angular_rad_s,
  };
  const isTold = Math.abs(command.linear) + Math.abs(command.lateral) + Math.abs(command.angular) > 0;
  const state = SHOWN_STATES.find((each) => each === message.state) ?? "unknown";
  return {
    robot: message.robot,
    state: state === "standing" && isTold ? "told" : state,
    level: message.level,
    since: seconds(message.since),
    command,
    actual: { linear: message.linear_m_s, angular: message.angular_rad_s },
    limit:
      message.limit_sensor === ""
        ? null
        : { sensor: message.limit_sensor, value: message.limit_value, unit: message.limit_unit },
    contact: message.contact,
    summary: message.summary,
    reason: message.reason,
  };
}

const OF_AGENT: Record<string, ShownState> = { dead: "dead", unresponsive: "late" };

// If there is no health report, only the state of the behaviour is known.
export function stateOf(health: Health | null, robot: Pick<RobotStatus, "name" | "agentPhase">): ShownState {
  if (!health) return OF_AGENT[robot.agentPhase] ?? "unknown";
  return health.robots.get(robot.name)?.state ?? "moving";
}

// A number for sorting; higher is worse. The numbers are in a table, because they are needed for
// thousands of robots several times per second.
const BADNESS = Object.fromEntries(
  SHOWN_STATES.map((state, i) => [state, SHOWN_STATES.length - i]),
) as Record<ShownState, number>;

export function badness(state: ShownState): number {
  return BADNESS[state];
}

// Returns whether the robot needs the user's attention.
export function isTrouble(state: ShownState): boolean {
  return BADNESS[state] >= BADNESS.told;
}

// Returns a sentence such as "has not moved for 20 s: commanded 0, sonar_00 reads 0.26 m".
export function sentenceOf({ summary, reason, since }: RobotHealth, now: number): string {
  if (summary === "") return "";
  const span = Math.max(0, now - since);
  const duration = span < 1 ? "" : ` for ${formatSpan(span)}`;
  return `${summary}${duration}${reason === "" ? "" : `: ${reason}`}`;
}

// Returns "20 s" for 20.4, and "2 min 5 s" for 125.
function formatSpan(span: number): string {
  const whole = Math.floor(span);
  if (whole < 60) return `${whole} s`;
  const rest = whole % 60;
  return `${Math.floor(whole / 60)} min${rest > 0 ? ` ${rest} s` : ""}`;
}

// Returns a text such as "0.30 m/s, 0.10 rad/s"; "0" if the robot is at rest.
export function motionText(linear: number, angular: number, lateral = 0): string {
  const parts = [
    Math.abs(linear) > 0 ? `${formatNumber(linear, 2)} m/s` : "",
    Math.abs(lateral) > 0 ? `${formatNumber(lateral, 2)} m/s sideways` : "",
    Math.abs(angular) > 0 ? `${formatNumber(angular, 2)} rad/s` : "",
  ].filter((part) => part !== "");
  return parts.join(", ") || "0";
}
