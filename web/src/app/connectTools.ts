// Connects the store with the tools that edit and measure in the view.
import { poseOf } from "../scene/poses";
import type { World3D } from "../scene/World3D";
import { allChosen, chosenOf } from "../state/editing";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";

export function connectTools(store: Store<State>, world: World3D): void {
  const { tools } = world;
  store.watch(
    (state) => ({ tool: state.editing?.tool ?? null }),
    ({ tool }) => tools.setTool(tool),
    shallowEqual,
  );
  store.watch(allChosen, (chosen) => tools.choose(chosen), sameNames);
  store.watch(chosenOf, () => showChosenPose(store, world));
  store.watch(
    ({ editing }) => editing !== null,
    () => showChosenPose(store, world),
  );
  store.watch(clickUseOf, (use) => {
    tools.clickUse = use;
    world.host.classList.toggle("aims", use !== "choose");
  });
  store.watch(
    ({ mapMode }) => mapMode,
    (mapMode) => world.setMap(mapMode),
  );
  store.watch(
    ({ ruler, editing }) => ({ ruler, from: editing?.wall?.from ?? null }),
    ({ ruler, from }) => world.showPoints(ruler ?? (from ? [{ ...from, z: 0 }] : [])),
    shallowEqual,
  );
}

// Shows the last reported pose of the selected body, except while the user drags the body.
export function showChosenPose(store: Store<State>, world: World3D): void {
  const state = store.get();
  if (world.tools.holds) return;
  const body = state.editing ? chosenOf(state) : null;
  const pose = body === null ? null : world.bodyPose(body);
  if (body === null || !pose) {
    if (state.chosenPose) store.set({ chosenPose: null });
    return;
  }
  const chosenPose = { body, ...poseOf(pose) };
  if (!state.chosenPose || !shallowEqual(state.chosenPose, chosenPose)) store.set({ chosenPose });
}

function clickUseOf({ placing, ruler, editing }: State): "choose" | "place" | "point" {
  if (placing) return "place";
  return ruler !== null || editing?.wall ? "point" : "choose";
}

function sameNames(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((name, i) => name === b[i]);
}
