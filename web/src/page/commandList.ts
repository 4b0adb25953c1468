// Everything that the command palette finds: commands, panels, layouts, robots, objects, sensors
// and topics.
import type { App } from "../app/App";
import { PANELS } from "../panels/registry";
import { hasAgent, imagesOf } from "../api/scene";
import { bodyPart } from "../state/parts";
import { OVERLAYS } from "../state/overlays";
import { PRESETS } from "../workspace/presets";
import type { Command } from "./controlCommands";
import { controlCommands } from "./controlCommands";

export type { Command } from "./controlCommands";

const MAX_FOUND = 50;

// Returns the commands that are possible at present.
export function commandsOf(app: App): Command[] {
  return [...controlCommands(app), ...viewCommands(app), ...placeCommands(app), ...robotCommands(app), ...objectCommands(app), ...topicCommands(app)];
}

// Returns the entries that contain each word of the text. Entries whose label begins with the first
// word come first.
export function findCommands(commands: readonly Command[], text: string): Command[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const fitting = commands.filter(({ group, label }) => {
    const whole = `${group} ${label}`.toLowerCase();
    return words.every((word) => whole.includes(word));
  });
  const begins = ({ label }: Command) => label.toLowerCase().startsWith(words[0] ?? "");
  return [...fitting.filter(begins), ...fitting.filter((each) => !begins(each))].slice(0, MAX_FOUND);
}

function viewCommands(app: App): Command[] {
  const { shown, mapMode, scene, ruler, filming } = app.store.get();
  const view = (label: string, key: string, run: () => void): Command => ({ group: "View", label, key, run });
  return [
    { group: "View", label: mapMode ? "Leave the map" : "Map", run: () => app.setMap(!mapMode) },
    { group: "View", label: ruler ? "End measuring" : "Measure", run: () => app.pointing.setMeasuring(!ruler) },
    ...(imagesOf(scene).length > 1 ? [{ group: "View", label: "Show all cameras", run: () => app.showAllCameras(true) }] : []),
    view("Reset view", "R", () => app.resetView()),
    view("Top view", "T", () => app.topView()),
    view("Follow", "F", () => app.toggleViewMode("follow")),
    view("Chase", "C", () => app.toggleViewMode("chase")),
    view("Robot's eye", "V", () => app.toggleViewMode("eye")),
    view("Free view", "O", () => app.orbit()),
    view("Copy link", "L", () => app.copyLink()),
    view("Save image", "X", () => void app.savePicture()),
    view(filming ? "End the video" : "Record video", "M", () => app.film()),
    ...OVERLAYS.map(({ name, label, key }) => ({
      group: "Overlay",
      label: `${shown[name] ? "Hide" : "Show"} ${label.toLowerCase()}`,
      key,
      run: () => app.toggle(name),
    })),
  ];
}

function placeCommands(app: App): Command[] {
  const state = app.store.get();
  const panels = PANELS.filter(({ isAvailable }) => isAvailable(state));
  return [
    ...panels.map(({ id, title, key }) => ({ group: "Panel", label: title, ...(key && { key }), run: () => app.panels.open(id) })),
    ...PRESETS.map((preset) => ({ group: "Layout", label: preset.title, run: () => app.layouts.showPreset(preset) })),
    ...state.layouts.map((saved) => ({ group: "Layout", label: saved.name, run: () => app.layouts.showSaved(saved) })),
  ];
}

function robotCommands(app: App): Command[] {
  const robots = app.store.get().status?.robots ?? [];
  return robots.map(({ name }) => ({ group: "Robot", label: name, run: () => app.select(name) }));
}

// Objects of the world, and the sensors of all bodies, which the inspector shows.
function objectCommands(app: App): Command[] {
  const bodies = app.store.get().scene?.bodies ?? [];
  return bodies.flatMap((body) => [
    ...(hasAgent(body) ? [] : [{ group: "Object", label: body.name, run: () => app.showPart(bodyPart(body.name)) }]),
    ...body.sensors.map(({ name }) => ({
      group: "Sensor",
      label: `${body.name} ${name}`,
      run: () => app.showPart({ body: body.name, kind: "sensor", name }),
    })),
  ]);
}

function topicCommands(app: App): Command[] {
  return app.store.get().topics.map(({ name }) => ({ group: "Topic", label: name, run: () => app.showTopic(name) }));
}
