// The visuals of a model, as its file describes them.

export interface ModelVisual {
  name: string;
  link: string | null;
  // kind, and size in metres; empty if the server does not describe the shape
  shape: Readonly<Record<string, unknown>>;
}

// The data of a material that the inspector panel shows.
export interface MaterialFacts {
  colour: string; // "#rrggbb", sRGB
  opacity: number;
  metalness: number;
  roughness: number;
  maps: readonly string[]; // "colour", "normals", …
}

// The data of a visual that the inspector panel shows.
export interface VisualFacts extends ModelVisual {
  materials: readonly MaterialFacts[];
}
