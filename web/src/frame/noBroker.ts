// Explains why there is no broker: a server that replays a recording has no broker, and no
// addresses for it.
import { ApiError } from "../api/JsonServer";

export const NO_BROKER = "A replay has no broker. Start a simulation with gsv run or gsv serve, and open this page there.";

export function isMissing(error: unknown): boolean {
  return error instanceof ApiError && error.httpStatus === 404;
}
