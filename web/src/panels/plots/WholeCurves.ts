// Fetches the plotted curves of three sources: a whole recording, the stored past of a running
// simulation, and the compared recording. The server needs time to read a recording. Until it has
// finished, the curve that it has read so far is requested repeatedly.
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
  server: Pick<PanelPorts["server"], "curve" | "pastCurve" | "comparedCurve">;
  plots: Pick<PanelPorts["plots"], "setSpan">;
};

// Each function is called repeatedly while the server reads a curve. `curve` is the part that was
// read so far.
export interface CurveEvents {
  onWhole(id: string, curve: WholeCurve): void; // a curve of the recording
  onPast(id: string, curve: WholeCurve): void; // a curve of a run's stored past
  onCompared(id: string, curve: WholeCurve): void; // a curve of the second recording of a comparison
}

export class WholeCurves {
  private readonly known = new Set<string>(); // curves that are being read, or were read
  private readonly compared = new Set<string>(); // curves of the second recording that are being read, or were read
  private simulation: string | null = null;
  private isReplay = false;
  private other = ""; // the second recording

  constructor(
    private readonly ports: WholeCurvePorts,
    private readonly events: CurveEvents,
  ) {}

  start(): void {
    this.ports.state.watch(
      ({ replay }) => replay !== null,
      // For a recording, the whole time range is plotted. For a running simulation, only the newest
      // seconds are plotted.
      (isReplay) => isReplay && this.ports.plots.setSpan(null),
    );
    this.ports.state.watch(
      ({ simulation, replay, kept, plots, comparison }) => ({
        simulation,
        isReplay: replay !== null,
        isKept: kept !== null,
        curves: plots.curves,
        other: comparison?.simulation,
      }),
      () => {
        this.ask();
        this.askOther();
      },
      shallowEqual,
    );
  }

  private ask(): void {
    const { simulation, replay, kept, plots } = this.ports.state.get();
    const isReplay = replay !== null;
    if (simulation !== this.simulation || isReplay !== this.isReplay) this.known.clear();
    this.simulation = simulation;
    this.isReplay = isReplay;
    const ids = new Set(plots.curves.map(({ id }) => id));
    for (const id of this.known) if (!ids.has(id)) this.known.delete(id);
    if ((!replay && !kept) || simulation === null) return;
    for (const curve of plots.curves) {
      if (this.known.has(curve.id)) continue;
      this.known.add(curve.id);
      const isWanted = () => this.simulation === simulation && this.isReplay === isReplay && this.known.has(curve.id);
      if (replay) {
        const get = (of: CurveOf) => this.ports.server.curve(simulation, of, MOST_SAMPLES);
        void this.read(curve, get, (read) => this.events.onWhole(curve.id, read), isWanted, true);
      } else {
        const get = (of: CurveOf) => this.ports.server.pastCurve(simulation, of, MOST_SAMPLES);
        void this.read(curve, get, (read) => this.events.onPast(curve.id, read), isWanted, false);
      }
    }
  }

  private askOther(): void {
    const { comparison, plots } = this.ports.state.get();
    const other = comparison?.simulation ? comparison.recording : "";
    if (other !== this.other) this.compared.clear();
    this.other = other;
    const ids = new Set(plots.curves.map(({ id }) => id));
    for (const id of this.compared) if (!ids.has(id)) this.compared.delete(id);
    if (other === "") return;
    for (const curve of plots.curves) {
      if (this.compared.has(curve.id)) continue;
      this.compared.add(curve.id);
      const isWanted = () => this.other === other && this.compared.has(curve.id);
      const get = (of: CurveOf) => this.ports.server.comparedCurve(of, MOST_SAMPLES);
      void this.read(curve, get, (read) => this.events.onCompared(curve.id, read), isWanted, true);
    }
  }

  // Requests the curve repeatedly until the server has read it completely. If the server cannot
  // read it and `isMissed` is true, informs the user.
  private async read(
    plotted: Curve,
    get: (of: CurveOf) => Promise<WholeCurve | null>,
    take: (curve: WholeCurve) => void,
    isWanted: () => boolean,
    isMissed: boolean,
  ): Promise<void> {
    const wishes = inputsOf(plotted).map(({ source, key }): CurveOf => {
      const { kind, ...of } = source;
      return { ...of, key };
    });
    const tell = (problem: string) => isMissed && isWanted() && this.tell(problem);
    try {
      for (;;) {
        const read = await Promise.all(wishes.map(get));
        if (read.includes(null) || !isWanted()) return;
        const curve = asOne(plotted, read as WholeCurve[]);
        take(curve);
        if (curve.done) return void tell(curve.problem);
        await new Promise((resolve) => setTimeout(resolve, POLL_MS));
        if (!isWanted()) return;
      }
    } catch (error) {
      // The values from playback are still plotted.
      tell((error as Error).message);
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
