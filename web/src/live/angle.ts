// Returns the equivalent angle in [-pi, pi].
export function shortWay(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
