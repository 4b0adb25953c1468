// The images of one camera, or of all cameras in a grid. Only visible cameras are subscribed
// to.
import type { CameraChoice } from "../../api/scene";
import { camerasOf, imagesOf } from "../../api/scene";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { icon } from "../../ui/icons";
import { smallButton } from "../../ui/smallButton";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { CameraTile } from "./CameraTile";
import { gridFor } from "./gridFor";

type Ports = Pick<PanelPorts, "state" | "topics" | "cameras">;

const SEPARATOR = " · ";
const ALL = "\0all"; // no topic has this name
const MAX_TILES = 60;

export function mount(ports: Ports): MountedPanel {
  const { state, cameras } = ports;
  const choice = element("select", { "aria-label": "Camera" });
  const place = element("div", { class: "camera-one" });
  const note = element("p", { class: "dim camera-note" });
  const hint = element("p", { class: "hint" }, "No robot has a camera.");
  let isOpen = false;
  // A depth camera that the user chose here; other panels do not know this choice.
  let only: CameraChoice | null = null;
  let tiles: CameraTile[] = [];

  let showsAll = state.get().allCameras;
  const chosen = () => only ?? state.get().camera;
  const shown = (): readonly CameraChoice[] => {
    if (showsAll) return imagesOf(state.get().scene).slice(0, MAX_TILES);
    const camera = chosen();
    return camera ? [camera] : [];
  };
  const sight = typeof IntersectionObserver === "undefined" ? null : new IntersectionObserver((entries) => follow(entries), { root: place });
  const follow = (entries: IntersectionObserverEntry[]) => {
    for (const { target, isIntersecting } of entries) {
      const tile = tiles.find((each) => each.element.parentElement === target);
      if (tile) isIntersecting && isOpen ? tile.listen() : tile.close();
    }
  };
  const build = () => {
    for (const tile of tiles) tile.close();
    sight?.disconnect();
    const wanted = shown();
    tiles = wanted.map((camera) => new CameraTile(camera, ports, showsAll ? nameOf(camera) : "Camera image"));
    place.className = showsAll ? "camera-grid" : "camera-one";
    const cells = tiles.map((tile) => (showsAll ? cellOf(tile) : tile.element));
    place.replaceChildren(...cells);
    arrange();
    const all = imagesOf(state.get().scene).length;
    setText(note, showsAll && all > MAX_TILES ? `The first ${MAX_TILES} of ${all} cameras. Choose another one above.` : "");
    hint.hidden = all > 0;
    choice.hidden = all === 0;
    choice.value = showsAll ? ALL : (chosen()?.topic ?? "");
    for (const button of zooms) button.hidden = showsAll || all === 0;
    grid.hidden = all < 2;
    setText(gridWord, showsAll ? "Show one camera" : "Show all cameras");
    listen();
  };
  const listen = () => {
    for (const tile of tiles) {
      tile.close();
      if (isOpen && (!showsAll || !sight)) tile.listen();
    }
    sight?.disconnect();
    if (isOpen && showsAll) for (const { element: frame } of tiles) sight?.observe(frame.parentElement!);
  };
  const cellOf = (tile: CameraTile) => {
    const name = nameOf(tile.camera);
    const open = element("button", { class: "camera-open", type: "button", title: `Show only ${name}`, onclick: () => showOnly(tile.camera) }, name);
    return element("div", { class: "camera-cell" }, open, tile.element);
  };
  const showOnly = (camera: CameraChoice) => {
    const isOfPage = camerasOf(state.get().scene).some(({ topic }) => topic === camera.topic);
    only = isOfPage ? null : camera;
    if (isOfPage && state.get().camera?.topic !== camera.topic) cameras.show(camera);
    if (showsAll) cameras.showAll(false);
    else build();
  };
  const arrange = () => {
    const { clientWidth, clientHeight } = place;
    const { columns, cellWidth } = gridFor(tiles.length, clientWidth, clientHeight);
    place.style.setProperty("--columns", `repeat(${columns}, ${cellWidth === null ? "minmax(0, 1fr)" : `${cellWidth}px`})`);
  };
  if (typeof ResizeObserver !== "undefined") new ResizeObserver(arrange).observe(place);
  const zoomBy = (factor: number) => () => tiles.forEach((tile) => tile.zoomBy(factor));
  const zooms = [
    smallButton("add", "Zoom in", zoomBy(1.25)),
    smallButton("minus", "Zoom out", zoomBy(1 / 1.25)),
    smallButton("enlarge", "Fit the image", zoomBy(0)),
  ];

  const gridWord = element("span", {});
  const grid = element("button", { class: "button small camera-all", type: "button", onclick: () => cameras.showAll(!showsAll) }, icon("grid"), gridWord);
  choice.addEventListener("change", () => {
    if (choice.value === ALL) return cameras.showAll(true);
    const camera = imagesOf(state.get().scene).find(({ topic }) => topic === choice.value);
    if (camera) showOnly(camera);
  });
  state.watch(
    ({ scene }) => imagesOf(scene),
    (all) => {
      if (only && !all.some(({ topic }) => topic === only!.topic)) only = null;
      const every = new Option(`All cameras (${all.length})`, ALL);
      choice.replaceChildren(...(all.length > 1 ? [every] : []), ...all.map((each) => new Option(nameOf(each), each.topic)));
      build();
    },
  );
  state.watch(
    ({ camera }) => camera?.topic,
    () => {
      only = null;
      build();
    },
  );
  state.watch(
    ({ allCameras }) => allCameras,
    (isOn) => {
      if (isOn === showsAll) return;
      showsAll = isOn;
      build();
    },
  );
  // If the simulation changes, a topic with the same name is another stream. So it is subscribed
  // again.
  state.watch(
    ({ simulation, view, replay }) => ({ simulation, isStarting: view === "starting", isRecorded: replay !== null }),
    listen,
    shallowEqual,
  );
  state.watch(
    ({ time }) => time,
    () => isOpen && tiles.forEach((tile) => tile.judgeAge()),
  );
  const setOpen = (open: boolean) => {
    isOpen = open;
    listen();
  };
  return {
    body: element("div", { class: "camera-body" }, hint, note, place),
    tools: [choice, grid, element("span", { class: "spacer" }), ...zooms],
    whileOpen: () => {
      setOpen(true);
      return () => setOpen(false);
    },
    afterMove: build,
  };
}

function nameOf({ robot, sensor }: CameraChoice): string {
  return robot + SEPARATOR + sensor;
}
