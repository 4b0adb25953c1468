// Requests the models, worlds and behaviours for setting up a simulation, and creates or edits
// simulations.
import type { Ros2Support } from "./ros2";
import { parseRos2Support } from "./ros2";
import type { RobotSetUp, Scenario } from "./scenario";
import { robotJson, scenarioJson } from "./scenario";
import type { JsonServer } from "./JsonServer";
import type { DroppedFile } from "./DroppedFile";
import { simulationPath } from "./JsonServer";
import { listAt, numbersAt, objectAt, textAt, textOr } from "./json";
import type { SceneDescription } from "./scene";
import { parseScene } from "./scene";

// The capabilities of a server.
export interface Abilities {
  creates: boolean; // whether simulations can be created and edited
  records: boolean;
  recordings: boolean; // whether recordings can be listed and replayed
  // Only for a replay: the recording's name, with which each viewer can open a separate replay.
  // Otherwise empty.
  recording: string;
}

// A model that can be added as a robot or an avatar.
export interface ModelChoice {
  name: string;
  isAvatar: boolean;
}

// An offered behaviour.
export interface BehaviourChoice {
  name: string;
  description: string;
  place: string; // host:pid
}

// The offered behaviours.
export interface Behaviours {
  offers: BehaviourChoice[];
  startCommand: string; // the command that starts a program which offers a behaviour
}

// The pose of a body that is set up or edited.
export interface BodyPlace {
  x: number;
  y: number;
  z?: number; // if absent: on the ground
  roll?: number;
  pitch?: number;
  yaw: number;
}

// An object that is not a robot: made from a model, or a copy of an existing or removed object.
export interface NewObject {
  name: string; // if empty: named after its model
  model?: string;
  copy_of?: string;
  place: BodyPlace | null; // if null: the first free place
}

// The start of a simulation that does not exist yet: its scene and its poses.
export interface Preview {
  scene: SceneDescription;
  poses: Float64Array; // x y z qx qy qz qw (metres) for each entry of scene.poses
  warnings: string[]; // parts of the files that could not be read
}

// The texts of the world file and the scenario file, and a list of what these files leave out.
export interface SavedWorld {
  sdf: string;
  scenario: string;
  warnings: string[];
}

const UPLOAD_TIMEOUT_MS = 300_000;

// The time limit of requests that read a world or start behaviours. They may take a long time.
const LONG_TIMEOUT_MS = 60_000;

export class SetUpApi {
  constructor(private readonly server: JsonServer) {}

  async abilities(): Promise<Abilities> {
    const answer = objectAt(await this.server.get("api/server"), "server");
    return {
      creates: answer.creates === true,
      records: answer.records === true,
      recordings: answer.recordings === true,
      recording: textOr(answer.recording, ""),
    };
  }

  async worlds(): Promise<string[]> {
    const answer = objectAt(await this.server.get("api/worlds"), "worlds");
    return listAt(answer.worlds, "worlds").map((world) => textAt(objectAt(world, "worlds").name, "name"));
  }

  async models(): Promise<ModelChoice[]> {
    const answer = objectAt(await this.server.get("api/models", LONG_TIMEOUT_MS), "models");
    return listAt(answer.models, "models").map((each) => {
      const model = objectAt(each, "models");
      return { name: textAt(model.name, "name"), isAvatar: model.is_avatar === true };
    });
  }

  // Returns the models that are not robots.
  async objectModels(): Promise<string[]> {
    const answer = objectAt(await this.server.get("api/models", LONG_TIMEOUT_MS), "models");
    return listAt(answer.objects ?? [], "objects").map((each) => textAt(objectAt(each, "objects").name, "name"));
  }

  async behaviours(constraint = ""): Promise<Behaviours> {
    const path = `api/behaviours?constraint=${encodeURIComponent(constraint)}`;
    const answer = objectAt(await this.server.get(path), "behaviours");
    const offers = listAt(answer.behaviours, "behaviours").map((each) => {
      const offer = objectAt(each, "behaviours");
      return {
        name: textAt(offer.name, "name"),
        description: textOr(offer.description, ""),
        place: `${textOr(offer.host, "")}:${String(offer.pid)}`,
      };
    });
    return { offers, startCommand: textOr(answer.start_command, "") };
  }

  async ros2(): Promise<Ros2Support> {
    return parseRos2Support(await this.server.get("api/ros2"));
  }

  // Returns the start of the simulation that this scenario describes, without creating it.
  async preview(scenario: Scenario): Promise<Preview> {
    const shown = { ...scenarioJson(scenario), name: "", record: false };
    const answer = objectAt(await this.server.post("api/preview", shown, LONG_TIMEOUT_MS), "preview");
    const warnings = listAt(answer.warnings ?? [], "warnings").map((each) => textOr(each, ""));
    const scene = parseScene(answer.scene);
    const poses = Float64Array.from(numbersAt(answer.poses, 7 * scene.poses.length, "poses"));
    return { scene, poses, warnings };
  }

  // Sends files that belong together. Returns the path of each file on the server's machine.
  async upload(files: readonly DroppedFile[]): Promise<string[]> {
    const begun = objectAt(await this.server.post("api/uploads", {}), "upload");
    const set = textAt(begun.upload, "upload");
    const places: string[] = [];
    for (const { path, content } of files) {
      const place = path.split("/").map(encodeURIComponent).join("/");
      const sent = this.server.put(`api/uploads/${set}/${place}`, await content(), UPLOAD_TIMEOUT_MS);
      const answer = objectAt(await sent, "upload");
      places.push(textAt(answer.path, "path"));
    }
    return places;
  }

  // Returns the name of the new simulation.
  async create(scenario: Scenario): Promise<string> {
    const status = await this.server.post("api/simulations", scenarioJson(scenario), LONG_TIMEOUT_MS);
    return textAt(objectAt(status, "status").name, "name");
  }

  async destroy(simulation: string): Promise<void> {
    await this.server.delete(simulationPath(simulation), LONG_TIMEOUT_MS);
  }

  // Returns the name of the new robot.
  async addRobot(simulation: string, robot: RobotSetUp, isAvatar: boolean): Promise<string> {
    const body = { ...robotJson(robot), avatar: isAvatar };
    const answer = await this.server.post(`${simulationPath(simulation)}/robots`, body, LONG_TIMEOUT_MS);
    return textAt(objectAt(answer, "robot").name, "name");
  }

  async removeRobot(simulation: string, robot: string): Promise<void> {
    await this.server.delete(`${simulationPath(simulation)}/robots/${encodeURIComponent(robot)}`);
  }

  // Returns the name of the new object.
  async addObject(simulation: string, { place, ...object }: NewObject): Promise<string> {
    const body = { ...object, ...place };
    const answer = await this.server.post(`${simulationPath(simulation)}/objects`, body, LONG_TIMEOUT_MS);
    return textAt(objectAt(answer, "object").name, "name");
  }

  async removeObject(simulation: string, object: string): Promise<void> {
    await this.server.delete(`${simulationPath(simulation)}/objects/${encodeURIComponent(object)}`);
  }

  // Returns the present state of the world as files. `file` is the name with which the scenario
  // refers to the world file.
  async saveWorld(simulation: string, file: string): Promise<SavedWorld> {
    const path = `${simulationPath(simulation)}/world?file=${encodeURIComponent(file)}`;
    const answer = objectAt(await this.server.get(path, LONG_TIMEOUT_MS), "world");
    const warnings = listAt(answer.warnings ?? [], "warnings").map((each) => textOr(each, ""));
    return { sdf: textAt(answer.sdf, "sdf"), scenario: textAt(answer.scenario, "scenario"), warnings };
  }

  async placeBody(simulation: string, body: string, place: BodyPlace): Promise<void> {
    await this.server.post(`${simulationPath(simulation)}/bodies/${encodeURIComponent(body)}/place`, place);
  }
}
