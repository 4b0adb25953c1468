// Computes a curve from other curves (inputs). The curve has a value at each time at which one of
// the inputs has a sample. The value is computed from the newest sample of each input.
import type { WholeCurve } from "../../api/curve";
import type { Expression } from "../../live/expression";

export function combined(curves: readonly WholeCurve[], evaluate: Expression["evaluate"]): WholeCurve {
  const next = curves.map(() => 0);
  const newest = curves.map(() => NaN);
  const [times, values]: [number[], number[]] = [[], []];
  for (;;) {
    const instants = curves.map(({ times: each }, i) => each[next[i]!] ?? Infinity);
    const time = Math.min(...instants);
    if (time === Infinity) break;
    instants.forEach((instant, i) => {
      if (instant === time) newest[i] = curves[i]!.values[next[i]!++]!;
    });
    if (next.some((each) => each === 0)) continue; // one of the inputs has no value yet
    times.push(time);
    values.push(evaluate(newest));
  }
  return {
    times: Float64Array.from(times),
    values: Float64Array.from(values),
    isWhole: curves.every(({ isWhole }) => isWhole),
    done: curves.every(({ done }) => done),
    problem: curves.find(({ problem }) => problem !== "")?.problem ?? "",
  };
}
