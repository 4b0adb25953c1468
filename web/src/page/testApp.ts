// An App with a test's own store, without a server or a 3D view.
import { Box3 } from "three";
import type { SimulationApi } from "../api/SimulationApi";
import type { Phase, RobotStatus, SimulationStatus } from "../api/status";
import { App } from "../app/App";
import { panelPorts } from "../app/panelPorts";
import { NOTHING_WANTED, Session } from "../app/Session";
import type { PanelPorts } from "../panels/contract/ports";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";

export function robotStatus(name: string, more: Partial<RobotStatus> = {}): RobotStatus {
  return {
    name,
    model: "b21r",
    behaviour: "wander",
    agentPhase: "waiting",
    detail: "",
    distance: 0,
    collisions: 0,
    ...more,
  };
}

export function simulationStatus(phase: Phase, more: Partial<SimulationStatus> = {}): SimulationStatus {
  return {
    phase,
    mode: "real_time",
    step: 0,
    time: 0,
    targetFactor: 1,
    realTimeFactor: 1,
    lateSteps: 0,
    waitingFor: "",
    failure: "",
    robots: [],
    replay: null,
    ...more,
  };
}

export function testApp(
  state: Partial<State> = {},
  api: Partial<SimulationApi> = {},
): { app: App; store: Store<State>; ports: PanelPorts } {
  const store = new Store<State>({
    ...initialState,
    connection: { phase: "open" },
    view: "open",
    simulation: "house",
    ...state,
  });
  const session = new Session(api as SimulationApi, store, NOTHING_WANTED);
  const app = new App(store, session, api as SimulationApi, () => null);
  return { app, store, ports: panelPorts(app, api as SimulationApi, { get: async () => ({ parts: [], bounds: new Box3() }) }) };
}
