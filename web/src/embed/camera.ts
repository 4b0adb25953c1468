// The address of an image that the server draws (docs/api.yaml, /view.jpg), for a view that the
// user rotates.

export interface Side {
  azimuth: number; // heading of the camera in degrees, counter-clockwise from x
  elevation: number; // angle by which the camera looks down, degrees
  zoom: number;
}

export const FIRST_SIDE: Side = { azimuth: 135, elevation: 34, zoom: 1 };

const DEGREES_PER_PIXEL = 0.4;
const LOWEST = -5; // degrees
const STEEPEST = 90;
const [SMALLEST_ZOOM, LARGEST_ZOOM] = [0.2, 20];

export function turned({ azimuth, elevation, zoom }: Side, dx: number, dy: number): Side {
  const heading = azimuth - dx * DEGREES_PER_PIXEL;
  return {
    azimuth: ((heading % 360) + 360) % 360,
    elevation: Math.min(STEEPEST, Math.max(LOWEST, elevation + dy * DEGREES_PER_PIXEL)),
    zoom,
  };
}

export function zoomed(side: Side, factor: number): Side {
  return { ...side, zoom: Math.min(LARGEST_ZOOM, Math.max(SMALLEST_ZOOM, side.zoom * factor)) };
}

// The attributes that determine the camera completely. If one of them is set, the user cannot
// rotate the view.
export const PLACING = ["eye", "target", "follow", "camera"] as const;
const PASSED = [...PLACING, "fov", "quality", "token", "simulation"] as const;

// The image that a <gsv-view> element requests.
export interface Wanted {
  src: string; // absolute address of the viewer; may contain a simulation
  attributes: Readonly<Record<string, string | null>>;
  side: Side;
  width: number; // px
  height: number;
}

export function imageUrl(name: "view.jpg" | "view.mjpeg", { src, attributes, side, width, height }: Wanted): string {
  const page = new URL(src);
  const url = new URL(name, page);
  const simulation = page.searchParams.get("simulation");
  if (simulation) url.searchParams.set("simulation", simulation);
  for (const attribute of PASSED) {
    const value = attributes[attribute];
    if (value) url.searchParams.set(attribute, value);
  }
  url.searchParams.set("size", `${width}x${height}`);
  if (name === "view.mjpeg" && attributes.fps) url.searchParams.set("fps", attributes.fps);
  if (!PLACING.some((attribute) => attributes[attribute])) {
    url.searchParams.set("azimuth", side.azimuth.toFixed(1));
    url.searchParams.set("elevation", side.elevation.toFixed(1));
    url.searchParams.set("zoom", side.zoom.toFixed(3));
  }
  return url.href;
}
