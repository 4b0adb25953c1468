// A part of the world that the user has selected: an object, or a link, joint or sensor of any
// body.
export interface WorldPart {
  body: string;
  kind: "body" | "link" | "joint" | "sensor";
  name: string; // for the kind "body": the name of the body
}
