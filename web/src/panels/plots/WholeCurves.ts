// Of a recording, has the server read each plotted value from end to end, and hands on what it has
// read so far until it is done.
import type { CurveOf, WholeCurve } from "../../api/curve";
import { MOST_SAMPLES } from "../../live/Series";
import { parseExpression } from "../../live/expression";
import type { Curve } from "../../state/plots";
import { inputsOf } from "../../state/plots";
import { shallowEqual } from "../../state/Store";
import type { PanelPorts } from "../contract/ports";
import { combined } from "./combined";

const POLL_MS = 300;

export type WholeCurvePorts = Pick<PanelPorts, "state" | "notices"> & {
  server: Pick<PanelPorts["server"], "curve">;
  plots: Pick<PanelPorts["plots"], "setSpan">;
};

export class WholeCurves {
  private readonly known = new Set<string>(); // curves that are read, or were
  private simulation: string | null = null;

  constructor(
    private readonly ports: WholeCurvePorts,
    private readonly onCurve: (id: string, curve: WholeCurve) => void,
  ) {}

  start(): void {
    this.ports.state.watch(
      ({ replay }) => replay !== null,
      // A recording is looked at from end to end; what runs, as it comes.
      (isReplay) => isReplay && this.ports.plots.setSpan(null),
    );
    this.ports.state.watch(
      ({ simulation, replay, plots }) => ({ simulation, isReplay: replay !== null, curves: plots.curves }),
      () => this.ask(),
      shallowEqual,
    );
  }

  private ask(): void {
    const { simulation, replay, plots } = this.ports.state.get();
    if (simulation !== this.simulation) this.known.clear();
    this.simulation = simulation;
    const ids = new Set(plots.curves.map(({ id }) => id));
    for (const id of this.known) if (!ids.has(id)) this.known.delete(id);
    if (!replay || simulation === null) return;
    for (const curve of plots.curves) {
      if (this.known.has(curve.id)) continue;
      this.known.add(curve.id);
      void this.read(simulation, curve);
    }
  }

  private async read(simulation: string, plotted: Curve): Promise<void> {
    const { id } = plotted;
    const wishes = inputsOf(plotted).map(({ source, key }): CurveOf => {
      const { kind, ...of } = source;
      return { ...of, key };
    });
    const isWanted = () => this.simulation === simulation && this.known.has(id);
    try {
      for (;;) {
        const read = await Promise.all(wishes.map((wish) => this.ports.server.curve(simulation, wish, MOST_SAMPLES)));
        if (!isWanted()) return;
        const curve = asOne(plotted, read);
        this.onCurve(id, curve);
        if (curve.done) return this.tell(curve.problem);
        await new Promise((resolve) => setTimeout(resolve, POLL_MS));
        if (!isWanted()) return;
      }
    } catch (error) {
      // What is played is plotted all the same.
      if (isWanted()) this.tell((error as Error).message);
    }
  }

  private tell(problem: string): void {
    if (problem) this.ports.notices.notify("error", `The plot does not cover the whole recording: ${problem}`);
  }
}

function asOne({ source, key }: Curve, read: readonly WholeCurve[]): WholeCurve {
  if (source.kind !== "expression") return read[0]!;
  return combined(read, parseExpression(key).evaluate);
}
