// The visuals of a model, as its file describes them.

export interface ModelVisual {
  name: string;
  link: string | null;
  // kind, and size in metres; empty if the server does not describe the shape
  shape: Readonly<Record<string, unknown>>;
}

// A material as inspectors show it.
export interface MaterialFacts {
  colour: string; // "#rrggbb", sRGB
  opacity: number;
  metalness: number;
  roughness: number;
  maps: readonly string[]; // "colour", "normals", …
}

// A visual as inspectors show it.
export interface VisualFacts extends ModelVisual {
  materials: readonly MaterialFacts[];
}
