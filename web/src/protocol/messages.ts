// The ROS 2 messages that the viewer reads, in the form of @foxglove/rosmsg2-serialization. The
// server sends their definitions with each channel. These types contain only the fields that the
// viewer uses.

export interface Time {
  sec: number;
  nsec: number;
}

export interface Point {
  x: number;
  y: number;
  z: number;
}

export interface Colour {
  r: number;
  g: number;
  b: number;
  a: number;
}

export interface ClockMessage {
  clock: Time;
}

// gsv_msgs/msg/Poses: seven numbers per pose (x y z qx qy qz qw), in the order of the scene's
// `poses`.
export interface PosesMessage {
  stamp: Time;
  step: bigint;
  layout_version: number;
  poses: Float64Array;
}

// gsv_msgs/msg/PackedPoses: the poses of PosesMessage, rounded
// (gsv/messages/msg/gsv_msgs/PackedPoses.msg).
export interface PackedPosesMessage {
  stamp: Time;
  step: bigint;
  layout_version: number;
  positions: Int32Array; // in units of 0.1 mm
  rotations: Uint16Array;
}

export interface RobotStatusMessage {
  name: string;
  model: string;
  behaviour: string;
  agent_state: string;
  detail: string;
  distance_m: number;
  collisions: bigint;
}

export interface SimulationStatusMessage {
  stamp: Time;
  step: bigint;
  state: string;
  mode: string;
  real_time_factor: number;
  target_factor: number;
  late_steps: bigint;
  waiting_for: string;
  robots: RobotStatusMessage[];
}

export interface DiagnosticArrayMessage {
  status: { level: number; name: string; message: string; values: { key: string; value: string }[] }[];
}

// gsv_msgs/msg/Health. `robots` lists all robots except those in the state "moving".
export interface HealthMessage {
  stamp: Time;
  step: bigint;
  stuck_after_s: number;
  moving: number;
  standing: number;
  stuck: number;
  contact: number;
  dead: number;
  late: number;
  robots: RobotHealthMessage[];
}

export interface RobotHealthMessage {
  robot: string;
  state: string;
  level: number;
  since: Time;
  command_linear_m_s: number;
  command_lateral_m_s: number;
  command_angular_rad_s: number;
  linear_m_s: number;
  angular_rad_s: number;
  limit_sensor: string;
  limit_value: number;
  limit_unit: string;
  contact: string;
  summary: string;
  reason: string;
}

// gsv_msgs/msg/Expectations, in the order of the scenario.
export interface ExpectationsMessage {
  stamp: Time;
  expectations: ExpectationMessage[];
}

export interface ExpectationMessage {
  name: string;
  yaml: string;
  where: string;
  state: string;
  has_margin: boolean;
  margin: number;
  unit: string;
  margin_at_s: number;
  time_s: number;
  step: bigint;
  detail: string;
  bodies: string[];
  places: ArrayLike<number>; // x y radius for each place
  boxes: ArrayLike<number>; // x0 x1 y0 y1 for each box
}

export const LINE_LIST = 5;

export interface MarkerMessage {
  header: { stamp: Time; frame_id: string };
  ns: string;
  id: number;
  type: number;
  action: number;
  color: Colour;
  points: Point[];
  colors: Colour[];
}

export interface MarkerArrayMessage {
  markers: MarkerMessage[];
}

export interface TransformMessage {
  header: { stamp: Time; frame_id: string };
  child_frame_id: string;
  transform: { translation: Point; rotation: Point & { w: number } };
}

export interface TransformsMessage {
  transforms: TransformMessage[];
}

export interface CompressedImageMessage {
  header: { stamp: Time; frame_id: string };
  format: string;
  data: Uint8Array;
}

export interface LifecycleEventMessage {
  stamp: Time;
  step: bigint;
  event: string;
  robot: string;
  detail: string;
}

export interface LogMessage {
  stamp: Time;
  level: number;
  name: string;
  msg: string;
}

export function seconds(time: Time): number {
  return time.sec + time.nsec * 1e-9;
}
