// The catalogue of readings: one struct for each sensor type. All code that writes, reads, sends or
// shows readings uses these structs. fields.h converts a struct to lists of values and labels.
//
// Robot behaviours get these structs (sdk/behaviour/sensors.h), in Python with the same field
// names. docs/sensors.md lists them; a test compares that table with the structs.
//
// Frames  REP-103: x forward, y left, z up.
// Units   metres, radians, seconds, or the unit of the field.
#pragma once

#include "gsv/readings/fields.h"

namespace gsv::readings {

// Parts.

struct Vector {
  double x = 0, y = 0, z = 0;
  static constexpr auto kFields =
      std::make_tuple(Value("x", "", &Vector::x),  //
                      Value("y", "", &Vector::y), Value("z", "", &Vector::z));
};

// A pose with fixed-axis roll, pitch and yaw as in URDF.
struct Placement {
  double x = 0, y = 0, z = 0;
  double roll = 0, pitch = 0, yaw = 0;
  static constexpr auto kFields = std::make_tuple(
      Value("x", "m", &Placement::x, "position"), Value("y", "m", &Placement::y, "position"),
      Value("z", "m", &Placement::z, "position"),
      Value("roll", "rad", &Placement::roll, "orientation"),
      Value("pitch", "rad", &Placement::pitch, "orientation"),
      Value("yaw", "rad", &Placement::yaw, "orientation"));
};

// A rotation as a unit quaternion.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
  static constexpr auto kFields =
      std::make_tuple(Value("w", "", &Quaternion::w), Value("x", "", &Quaternion::x),
                      Value("y", "", &Quaternion::y), Value("z", "", &Quaternion::z));
};

// Components from 0 to 1.
struct Colour {
  double red = 1, green = 1, blue = 1;
  static constexpr auto kFields =
      std::make_tuple(Value("red", "", &Colour::red), Value("green", "", &Colour::green),
                      Value("blue", "", &Colour::blue));
};

// Readings.

// The reading of an ultrasonic range sensor.
struct Sonar {
  static constexpr const char* kType = "sonar";
  double range = 0;  // distance to the nearest echo; the maximum range if there is none
  static constexpr auto kFields = std::make_tuple(Value("range", "m", &Sonar::range));
};

// The scan of a lidar.
struct Lidar {
  static constexpr const char* kType = "lidar";
  std::span<const double> ranges;  // one per beam; see docs/sensors.md for infinite values
  // One per beam; empty if the lidar does not measure intensities. In a reading, intensities follow
  // the ranges. The layout cannot distinguish the two, so Decode() puts all values into `ranges`.
  std::span<const double> intensities;
  static constexpr auto kFields = std::make_tuple(Value("ranges", "m", &Lidar::ranges));

  // The name of the lidar parameter that enables intensities if its value is > 0.
  static constexpr const char* kIntensityParameter = "intensity_scale";
  // Returns the decoded values of a lidar with intensities, with the intensities in their own
  // member.
  Lidar WithIntensities() const {
    const std::size_t beams = ranges.size() / 2;
    return {ranges.first(beams), ranges.last(beams)};
  }
};

// The pose of the sensor in the world.
struct Positioning {
  static constexpr const char* kType = "positioning";
  Placement world_from_sensor;
  static constexpr auto kFields =
      std::make_tuple(Value("world_from_sensor", "", &Positioning::world_from_sensor, "pose"));
};

// Values are in the sensor's frame. The specific force of a sensor at rest is 9.8 m/s² upwards.
struct Imu {
  static constexpr const char* kType = "imu";
  Vector angular_velocity;
  Vector specific_force;
  std::optional<Quaternion> world_from_sensor;  // empty if the IMU does not measure orientation
  static constexpr auto kFields =
      std::make_tuple(Value("angular_velocity", "rad/s", &Imu::angular_velocity),
                      Value("specific_force", "m/s²", &Imu::specific_force, "linear_acceleration"),
                      Value("world_from_sensor", "", &Imu::world_from_sensor, "orientation"));
};

// The robot's motion since the start, computed from the rotation of the wheels.
struct Odometry {
  static constexpr const char* kType = "odometry";
  double x = 0, y = 0, yaw = 0;    // pose of the base in the frame of its start
  double linear = 0, angular = 0;  // forward velocity, m/s; turning rate, rad/s
  double lateral = 0;  // velocity to the left, m/s; missing in readings of gsv 0.1 and earlier
  static constexpr auto kFields =
      std::make_tuple(Value("x", "m", &Odometry::x, "pose.pose.position"),
                      Value("y", "m", &Odometry::y, "pose.pose.position"),
                      Value("yaw", "rad", &Odometry::yaw, "pose.pose.orientation"),
                      Value("linear", "m/s", &Odometry::linear, "twist.twist.linear"),
                      Value("angular", "rad/s", &Odometry::angular, "twist.twist.angular"),
                      OptionalValue("lateral", "m/s", &Odometry::lateral, "twist.twist.linear"));
};

// The position (WGS84) and velocity that a GNSS receiver measures. The altitude is the height above
// the WGS84 ellipsoid.
struct Navsat {
  static constexpr const char* kType = "navsat";
  double latitude_deg = 0, longitude_deg = 0, altitude = 0;  // degrees, degrees, m
  double east = 0, north = 0, up = 0;                        // velocity of the sensor, m/s
  static constexpr auto kFields = std::make_tuple(
      Value("latitude_deg", "°", &Navsat::latitude_deg, "latitude"),
      Value("longitude_deg", "°", &Navsat::longitude_deg, "longitude"),
      Value("altitude", "m", &Navsat::altitude), Value("east", "m/s", &Navsat::east),
      Value("north", "m/s", &Navsat::north), Value("up", "m/s", &Navsat::up));
};

// The field that a magnetometer measures.
struct Magnetometer {
  static constexpr const char* kType = "magnetometer";
  Vector field;  // magnetic field in the sensor's frame
  static constexpr auto kFields =
      std::make_tuple(Value("field", "T", &Magnetometer::field, "magnetic_field"));
};

// The height that an altimeter measures.
struct Altimeter {
  static constexpr const char* kType = "altimeter";
  double position = 0, velocity = 0;  // height above the reference height, and its rate
  double reference = 0;               // reference height in the world
  static constexpr auto kFields =
      std::make_tuple(Value("position", "m", &Altimeter::position, "vertical_position"),
                      Value("velocity", "m/s", &Altimeter::velocity, "vertical_velocity"),
                      Value("reference", "m", &Altimeter::reference, "vertical_reference"));
};

// One contact of a bumper, in the sensor's frame. The normal points from the robot to the other
// body. The force acts on the robot: the mean over the last step. With planar kinematics, the force
// is zero except in contacts with rigid bodies.
struct Touch {
  std::string other;  // name of the other body
  Vector point, normal;
  double depth = 0;  // penetration depth, m
  // Approach speed at which the contact began; 0 if the contact began before this step.
  double closing_speed = 0;
  Vector force;
  static constexpr auto kFields = std::make_tuple(
      Value("other", "", &Touch::other), Value("point", "m", &Touch::point),
      Value("normal", "", &Touch::normal), Value("depth", "m", &Touch::depth),
      Value("closing_speed", "m/s", &Touch::closing_speed), Value("force", "N", &Touch::force));
};
// The contacts of a bumper.
struct Contact {
  static constexpr const char* kType = "contact";
  std::vector<Touch> touches;
  static constexpr auto kFields =
      std::make_tuple(Value("touches", "", &Contact::touches, "contacts"));
};

// The force and torque that a joint transmits. The torque is about the joint's origin.
struct ForceTorque {
  static constexpr const char* kType = "force_torque";
  Vector force, torque;
  static constexpr auto kFields =
      std::make_tuple(Value("force", "N", &ForceTorque::force, "wrench.force"),
                      Value("torque", "N m", &ForceTorque::torque, "wrench.torque"));
};

// The state of one joint: position in rad and velocity in rad/s; for prismatic joints in m and m/s.
struct EncodedJoint {
  std::string name;
  double position = 0, velocity = 0;
  static constexpr auto kFields = std::make_tuple(Value("name", "", &EncodedJoint::name),
                                                  Value("position", "", &EncodedJoint::position),
                                                  Value("velocity", "", &EncodedJoint::velocity));
};
// The states of all encoded joints, in the order of the model.
struct JointEncoders {
  static constexpr const char* kType = "joint_encoders";
  std::vector<EncodedJoint> joints;
  static constexpr auto kFields = std::make_tuple(Value("joints", "", &JointEncoders::joints, ""));
};

// The state of a battery.
struct Battery {
  static constexpr const char* kType = "battery";
  double voltage = 0, current = 0;  // current that is drawn from the battery
  double charge = 0, capacity = 0;  // charge now, and when the battery is full, Ah
  double fraction = 0;              // charge / capacity, from 0 to 1
  static constexpr auto kFields = std::make_tuple(
      Value("voltage", "V", &Battery::voltage), Value("current", "A", &Battery::current),
      Value("charge", "Ah", &Battery::charge), Value("capacity", "Ah", &Battery::capacity),
      Value("fraction", "", &Battery::fraction, "percentage"));
};

// One model in the view of a logical camera.
struct Sighting {
  std::string name;
  Placement sensor_from_model;  // pose of the model's frame in the sensor's frame
  static constexpr auto kFields =
      std::make_tuple(Value("name", "", &Sighting::name),
                      Value("sensor_from_model", "", &Sighting::sensor_from_model, "bbox.center"));
};
// The models in the camera's frustum, with their poses.
struct LogicalCamera {
  static constexpr const char* kType = "logical_camera";
  std::vector<Sighting> sightings;
  static constexpr auto kFields =
      std::make_tuple(Value("sightings", "", &LogicalCamera::sightings, "detections"));
};

// One message that a radio has received.
struct HeardMessage {
  std::uint64_t number = 0;    // number of the message, counted from 1 since the radio was opened
  double sent = 0;             // simulated time of sending
  double strength = 0;         // strength at the receiver
  std::string sender;          // robot
  std::string content_base64;  // in Base64, because labels are text
  static constexpr auto kFields = std::make_tuple(
      Value("number", "", &HeardMessage::number), Value("sent", "s", &HeardMessage::sent),
      Value("strength", "dBm", &HeardMessage::strength, "strength_dbm"),
      Value("sender", "", &HeardMessage::sender),
      Value("content_base64", "", &HeardMessage::content_base64));
};
// The messages in a radio's inbox.
struct Radio {
  static constexpr const char* kType = "radio";
  std::vector<HeardMessage> messages;  // ordered from the oldest to the newest
  static constexpr auto kFields = std::make_tuple(Value("messages", "", &Radio::messages));
};

// The distance to one radio anchor, as an ultra-wideband (UWB) tag measures it.
struct Ranging {
  static constexpr const char* kType = "ranging";
  // Infinite if the anchor was not received.
  double distance = std::numeric_limits<double>::infinity();
  static constexpr auto kFields =
      std::make_tuple(Value("distance", "m", &Ranging::distance, "range"));
};

// The sound at a microphone.
struct Microphone {
  static constexpr const char* kType = "microphone";
  double level = 0;  // sound level of all sounds, dB re 20 uPa
  // Frequency of the loudest sound; 0 if no sound is louder than the ambient noise.
  double frequency = 0;
  std::string source;  // ROBOT/SPEAKER of the loudest sound
  static constexpr auto kFields =
      std::make_tuple(Value("level", "dB", &Microphone::level, "level_db"),
                      Value("frequency", "Hz", &Microphone::frequency, "frequency_hz"),
                      Value("source", "", &Microphone::source));
};

// The light that a lamp emits.
struct Lamp {
  static constexpr const char* kType = "lamp";
  double brightness = 0;  // 0: off, 1: full
  Colour colour;
  static constexpr auto kFields = std::make_tuple(Value("brightness", "", &Lamp::brightness),
                                                  Value("colour", "", &Lamp::colour, "color"));
};

// The state of a gripper's fingers.
struct Gripper {
  static constexpr const char* kType = "gripper";
  double opening = 0;         // distance between the fingers, m
  bool told_to_open = false;  // true if the last command was to open, false if to close
  std::string held;           // name of the attached body; empty if there is none
  static constexpr auto kFields = std::make_tuple(
      Value("opening", "m", &Gripper::opening, "opening_m"),
      Value("told_to_open", "", &Gripper::told_to_open), Value("held", "", &Gripper::held));
};

// The sound that a speaker plays. All numbers are 0 during silence.
struct Speaker {
  static constexpr const char* kType = "speaker";
  std::string name;                  // name of the sound; empty for silence
  double frequency = 0, volume = 0;  // frequency in Hz; volume from 0 to 1
  double elapsed = 0, left = 0;      // seconds since the sound's start, and until its end
  static constexpr auto kFields = std::make_tuple(
      Value("name", "", &Speaker::name, "sound"),
      Value("frequency", "Hz", &Speaker::frequency, "frequency_hz"),
      Value("volume", "", &Speaker::volume), Value("elapsed", "s", &Speaker::elapsed, "elapsed_s"),
      Value("left", "s", &Speaker::left, "left_s"));
};

// The reading of a camera has the size of the image. The image itself is not part of the values.
struct Camera {
  static constexpr const char* kType = "camera";
  // The type of a camera with a wide-angle lens.
  static constexpr const char* kWideAngleType = "wideangle_camera";
  int width = 0, height = 0;
  static constexpr auto kFields =
      std::make_tuple(Value("width", "px", &Camera::width), Value("height", "px", &Camera::height));
};

// A depth image; rows from the top.
struct DepthImage {
  static constexpr const char* kType = "depth_camera";
  int width = 0, height = 0;
  std::span<const double> depth;  // distance along the camera's axis; infinite for the background
  static constexpr auto kFields = std::make_tuple(Value("width", "px", &DepthImage::width),
                                                  Value("height", "px", &DepthImage::height),
                                                  Value("depth", "m", &DepthImage::depth));
  bool IsComplete() const { return depth.size() == std::size_t(1) * width * height; }
};

// An image of labels; rows from the top. A pixel with label n shows names[n - 1]; label 0 is the
// background.
struct SegmentedImage {
  static constexpr const char* kType = "segmentation_camera";
  int width = 0, height = 0;
  std::span<const double> pixels;  // the label of each pixel
  std::span<const std::string> names;
  static constexpr auto kFields = std::make_tuple(
      Value("width", "px", &SegmentedImage::width), Value("height", "px", &SegmentedImage::height),
      Value("pixels", "", &SegmentedImage::pixels), Value("names", "", &SegmentedImage::names));
  bool IsComplete() const { return pixels.size() == std::size_t(1) * width * height; }
};

// A thermal image; rows from the top. Every temperature is a multiple of `resolution`.
struct ThermalImage {
  static constexpr const char* kType = "thermal_camera";
  int width = 0, height = 0;
  double resolution = 0;                // the smallest difference of two temperatures, K
  std::span<const double> temperature;  // one value per pixel, K
  static constexpr auto kFields = std::make_tuple(
      Value("width", "px", &ThermalImage::width), Value("height", "px", &ThermalImage::height),
      Value("resolution", "K", &ThermalImage::resolution),
      Value("temperature", "K", &ThermalImage::temperature));
  bool IsComplete() const { return temperature.size() == std::size_t(1) * width * height; }
};

// An image of surface normals; rows from the top. Each pixel has x, y, z in the sensor frame: the
// unit normal of the visible surface, which points towards the camera. NaN where it is unknown.
struct NormalImage {
  static constexpr const char* kType = "normals_camera";
  int width = 0, height = 0;
  std::span<const double> normals;  // three values per pixel
  static constexpr auto kFields = std::make_tuple(Value("width", "px", &NormalImage::width),
                                                  Value("height", "px", &NormalImage::height),
                                                  Value("normals", "", &NormalImage::normals));
  bool IsComplete() const { return normals.size() == std::size_t(3) * width * height; }
};

// A box in pixels, counted from the image's upper left corner.
struct BoundingBox {
  std::string name;
  double left = 0, top = 0, right = 0, bottom = 0;  // pixels
  static constexpr auto kFields = std::make_tuple(
      Value("name", "", &BoundingBox::name), Value("left", "px", &BoundingBox::left, "bbox.center"),
      Value("top", "px", &BoundingBox::top, "bbox.center"),
      Value("right", "px", &BoundingBox::right, "bbox.size_x"),
      Value("bottom", "px", &BoundingBox::bottom, "bbox.size_y"));
};
// The boxes of all models with a visible pixel, ordered by name.
struct BoundingBoxes {
  static constexpr const char* kType = "boundingbox_camera";
  std::vector<BoundingBox> boxes;
  static constexpr auto kFields =
      std::make_tuple(Value("boxes", "", &BoundingBoxes::boxes, "detections"));
};

}  // namespace gsv::readings
