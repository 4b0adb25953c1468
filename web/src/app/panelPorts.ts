// Implements the ports with which panels access this page.
import type { SimulationApi } from "../api/SimulationApi";
import type { ModelLibrary } from "../scene/ModelLibrary";
import { visualFacts } from "../scene/visualFacts";
import type { PanelPorts } from "../panels/contract/ports";
import type { App } from "./App";
import { notify } from "./notices";

export function panelPorts(app: App, api: SimulationApi, library: Pick<ModelLibrary, "get">): PanelPorts {
  const { store, session } = app;
  return {
    state: store,
    topics: session,
    traffic: { counts: () => session.counts(), choose: (topic) => store.set({ topic }), open: (topic) => app.showTopic(topic) },
    server: {
      figures: () => api.metrics.figures(),
      parameter: (name) => session.parameter(name),
      log: (simulation) => api.log(simulation),
      output: (simulation, robot) => api.output(simulation, robot),
      curve: (simulation, of, most) => api.curve(simulation, of, most),
      pastCurve: (simulation, of, most) => app.past.curve(simulation, of, most),
      comparedCurve: (of, most) => app.compare.curve(of, most),
    },
    commands: {
      list: (simulation) => api.commands(simulation),
      run: (simulation, command, given) => api.command(simulation, command, given),
    },
    control: {
      take: () => app.people.want(true),
      resume: () => app.startPauseOrResume(),
      setDriven: (driven) => store.set({ driven }),
      drive: (simulation, robot, drive) => api.drive(simulation, robot, drive),
      joints: (simulation, body) => api.joints(simulation, body),
      showJoints: () => app.showJoints(),
      commandJoint: (simulation, body, joint, kind, value) => api.commandJoint(simulation, body, joint, kind, value),
    },
    shapes: { visuals: async (model, links) => visualFacts(await library.get(model, links)) },
    replay: { seek: (time) => app.replay.seek(time) },
    robots: {
      select: (robot) => app.select(robot),
      inspect: (part) => app.inspect(part),
      pick: (body, isAdding) => app.pick(body, isAdding),
      filter: (change) => app.filterRobots(change),
      follow: () => app.toggleViewMode("follow"),
    },
    edits: { pose: (pose) => app.editActions.pose([pose]) },
    cameras: { show: (camera) => app.showCamera(camera), showAll: (isOn) => app.showAllCameras(isOn) },
    plots: {
      add: (source, key, unit) => app.plot(source, key, unit),
      remove: (curve) => app.unplot(curve),
      setSpan: (span) => store.set(({ plots }) => ({ plots: { ...plots, span } })),
      setAgainst: (against) => store.set(({ plots }) => ({ plots: { ...plots, against } })),
      showEvents: (events) => store.set(({ plots }) => ({ plots: { ...plots, events } })),
    },
    notices: {
      notify: (kind, sentence) => notify(store, kind, sentence),
      copy: (text, done) => app.copy(text, done),
    },
  };
}
