// The page's pictograms, drawn on a square of 24.

const PATHS = {
  play: "M7 4.5v15l13-7.5z",
  pause: "M6.500 4.500h4v15h-4zM13.500 4.500h4v15h-4z",
  stop: "M6 6h12v12H6z",
  step: "M5 4.500v15l10-7.500zM16.500 4.500h3v15h-3z",
  gauge:
    "M12 4a9 9 0 0 0-9 9c0 2.300.9 4.500 2.300 6h13.400A9 9 0 0 0 21 13a9 9 0 0 0-9-9zm4.600 4.200.9.8-3.500 5a2.300 2.300 0 1 1-1.700-1.600z",
  toStart: "M19 4.500v15L9 12zM4.500 4.500h3v15h-3z",
  toEnd: "M5 4.500v15l10-7.500zM16.500 4.500h3v15h-3z",
  stepBack: "M19 5h-2.500v14H19zM14 5v14L4.500 12z",
  stepOn: "M5 5h2.500v14H5zM10 5v14l9.500-7z",
  loop: "M7 7h10v3l4-4-4-4v3H5v6h2zm10 10H7v-3l-4 4 4 4v-3h12v-6h-2z",
  reset: "M12 5a7 7 0 1 1-6.700 5l-1.900-.6A9 9 0 1 0 12 3V0L7.500 4 12 8z",
  top: "M12 3l9 5-9 5-9-5zM3 12l9 5 9-5v2.300l-9 5-9-5z",
  home: "M12 3.500 2.500 12H5v8h5.500v-5.500h3V20H19v-8h2.500z",
  follow:
    "M12 2v3.100A7 7 0 0 1 18.900 11H22v2h-3.100A7 7 0 0 1 13 18.900V22h-2v-3.100A7 7 0 0 1 5.100 13H2v-2h3.100A7 7 0 0 1 11 5.100V2zm0 5a5 5 0 1 0 0 10 5 5 0 0 0 0-10zm0 2.500a2.500 2.500 0 1 1 0 5 2.500 2.500 0 0 1 0-5z",
  beams:
    "M4.500 19.500a3 3 0 1 0 0-.1zM8 15 19 3.500l1.500 1.400L9.400 16.400zM9.500 18.200 21.500 14l.7 1.900-12 4.200zM4.200 13.800 8.500 2l1.900.7-4.300 11.800z",
  label: "M3 5h11l7 7-7 7H3zm3.500 5.500a1.500 1.500 0 1 0 0 3 1.500 1.500 0 0 0 0-3z",
  grid: "M3 3h18v18H3zm2 2v4h4V5zm6 0v4h4V5zm6 0v4h2V5zM5 11v4h4v-4zm6 0v4h4v-4zm6 0v4h2v-4zM5 17v2h4v-2zm6 0v2h4v-2zm6 0v2h2v-2z",
  help: "M12 2a10 10 0 1 0 0 20 10 10 0 0 0 0-20zm-1 14.500h2v2h-2zm1-11a4 4 0 0 1 4 4c0 2.500-3 2.700-3 5.500h-2c0-3.600 3-3.800 3-5.500a2 2 0 0 0-4 0H8a4 4 0 0 1 4-4z",
  list: "M4 5h3v3H4zm5 .5h11v2H9zM4 10.500h3v3H4zm5 .5h11v2H9zM4 16h3v3H4zm5 .5h11v2H9z",
  camera: "M3 7h4l2-2.500h6L17 7h4v12H3zm9 2.500a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  enlarge:
    "M4 4h7v2H7.400l3.800 3.800-1.400 1.400L6 7.400V11H4zm16 16h-7v-2h3.600l-3.800-3.800 1.400-1.400 3.800 3.800V13h2z",
  close:
    "M6.400 5 12 10.600 17.600 5 19 6.400 13.400 12l5.600 5.600-1.400 1.400-5.600-5.600L6.400 19 5 17.600l5.600-5.600L5 6.400z",
  broker: "M9 3h6v5h-2v3h6v5h2v5h-6v-5h2v-3H7v3h2v5H3v-5h2v-5h6V8H9z",
  chase: "M12 2 19 12h-4v4H9v-4H5zM9 18h6v2H9zm0 3h6v1.500H9z",
  eye: "M12 5c5 0 8.700 3.600 10 7-1.300 3.400-5 7-10 7S3.300 15.400 2 12c1.300-3.400 5-7 10-7zm0 2.500a4.500 4.500 0 1 0 0 9 4.500 4.500 0 0 0 0-9zm0 2.200a2.300 2.300 0 1 1 0 4.600 2.300 2.300 0 0 1 0-4.600z",
  layers:
    "M12 3l9 5-9 5-9-5zM4.800 11.300 12 15.300l7.200-4L21 12.400l-9 5-9-5zM4.800 15.300 12 19.300l7.200-4L21 16.400l-9 5-9-5z",
  share: "M12 2l5 5-1.400 1.400L13 5.800V15h-2V5.800L8.400 8.400 7 7zM5 10h3v2H7v8h10v-8h-1v-2h3v12H5z",
  link: "M10.600 13.400a4 4 0 0 1 0-5.700l3.600-3.500a4 4 0 0 1 5.600 5.600l-2 2-1.400-1.400 2-2a2 2 0 0 0-2.800-2.800L12 9.100a2 2 0 0 0 0 2.900zm2.800-2.800a4 4 0 0 1 0 5.700l-3.600 3.500a4 4 0 0 1-5.600-5.600l2-2 1.400 1.400-2 2a2 2 0 0 0 2.800 2.800l3.600-3.500a2 2 0 0 0 0-2.900z",
  film: "M3 6h13v4l5-3v10l-5-3v4H3z",
  plot: "M4 4h2v14h15v2H4zm4 9 4-5 3.500 3.500L20 5.500l1.500 1.300-6 7.700L12 11l-2.400 3.200z",
  save: "M11 3h2v9l3-3 1.400 1.400L12 15.800l-5.400-5.400L8 9l3 3zM4 16h2v3h12v-3h2v5H4z",
  add: "M11 4h2v7h7v2h-7v7h-2v-7H4v-2h7z",
  edit: "M4 16.800V20h3.200L17.500 9.700l-3.200-3.200zM15.700 5.100l3.200 3.200 1.300-1.300a1 1 0 0 0 0-1.400l-1.800-1.800a1 1 0 0 0-1.400 0z",
  undo: "M9 4 3 9.500 9 15v-4h5a4 4 0 0 1 0 8H8v2h6a6 6 0 0 0 0-12H9z",
  turnLeft: "M12 5a7 7 0 1 1-6.700 5l-1.900-.6A9 9 0 1 0 12 3V0L7.500 4 12 8z",
  turnRight: "M12 5a7 7 0 1 0 6.700 5l1.900-.6A9 9 0 1 1 12 3V0l4.500 4L12 8z",
  redo: "m15 4 6 5.500-6 5.500v-4h-5a4 4 0 0 0 0 8h6v2h-6a6 6 0 0 1 0-12h5z",
  open: "M3 5h7l2 2h9v3H7l-3 8H3zm5 7h14l-3 8H5z",
  join: "M4 4h8v2H6v12h6v2H4zm10.500 3.500L19 12l-4.500 4.500-1.400-1.400 2.100-2.100H9v-2h6.200l-2.100-2.100z",
  recordings: "M3 4h18v16H3zm2 2v2h2V6zm0 5v2h2v-2zm0 5v2h2v-2zM17 6v2h2V6zm0 5v2h2v-2zm0 5v2h2v-2zM9 6v12h6V6z",
  people: "M9 4a4 4 0 1 1 0 8 4 4 0 0 1 0-8zm7.500 1a3.500 3.500 0 1 1-2 6.400A6 6 0 0 0 15 8c0-1-.3-2-.700-2.800.600-.200 1.300-.200 2.200-.200zM2 20c0-4 3-6.500 7-6.500s7 2.500 7 6.500zm15.900 0c0-2.600-1-4.700-2.600-6.200 3.800-.300 6.700 2 6.700 6.200z",
  record: "M12 5a7 7 0 1 1 0 14 7 7 0 0 1 0-14z",
  log: "M5 3h14v18H5zm3 4v1.800h8V7zm0 4v1.800h8V11zm0 4v1.800h5V15z",
  pulse: "M2 11h5l2.500-6.500 5 14L17 11h5v2h-3.600l-4 8-5-13.800L8.400 13H2z",
  status: "M12 2a10 10 0 1 1 0 20 10 10 0 0 1 0-20zm0 2a8 8 0 1 0 0 16 8 8 0 0 0 0-16zm-1 6h2v7h-2zm0-3.500h2v2h-2z",
  check: "M3 3h18v18H3zm2 2v14h14V5zm4.700 11.500-3.700-3.700 1.400-1.400 2.300 2.300 5.900-5.900 1.400 1.400z",
  find: "M3 4h18v16H3zm2 2v12h14V6zm2.400 2.600L10.800 12l-3.400 3.400L6 14l2-2-2-2zM12 14h5v2h-5z",
  topics: "M4 4h6v2H6v12h4v2H4zm10 0h6v16h-6v-2h4V6h-4zM8 8h8v2H8zm0 3h8v2H8zm0 3h5v2H8z",
  inspect: "M10 3a7 7 0 0 1 5.600 11.200l5 5-1.400 1.400-5-5A7 7 0 1 1 10 3zm0 2a5 5 0 1 0 0 10 5 5 0 0 0 0-10z",
  layout: "M3 4h18v16H3zm2 2v12h8V6zm10 0v5h4V6zm0 7v5h4v-5z",
  more: "M5 10a2 2 0 1 1 0 4 2 2 0 0 1 0-4zm7 0a2 2 0 1 1 0 4 2 2 0 0 1 0-4zm7 0a2 2 0 1 1 0 4 2 2 0 0 1 0-4z",
  copy: "M8 3h12v13H8zM4 7h2v11h11v2H4z",
} as const;

export type IconName = keyof typeof PATHS;

const SVG = "http://www.w3.org/2000/svg";

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name]);
  path.setAttribute("fill-rule", "evenodd");
  svg.append(path);
  return svg;
}

export function setIcon(svg: SVGSVGElement, name: IconName): void {
  svg.querySelector("path")?.setAttribute("d", PATHS[name]);
}
