// A part of the world that the user has selected: an object, or a link, joint or sensor of any
// body.
export interface WorldPart {
  body: string;
  kind: "body" | "link" | "joint" | "sensor";
  name: string; // that of the body itself for the kind "body"
}
