// A behaviour reads every sensor in three ways: inside the simulation's process, through CORBA, and
// through the sensor's own IDL interface. The results must be equal.
#include "sdk/behaviour/sensors.h"

#include <cmath>

#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/orb/orb.h"
#include "gsv/services/hardware_servants.h"
#include "gsv/simulation/testing/test_simulation.h"
#include "idl/actuators.hh"
#include "idl/sensors.hh"
#include "sdk/behaviour/behaviour.h"
#include "sdk/remote_robot.h"

namespace gsv {
namespace {

using namespace std::chrono_literals;

// The reading 50 ms after the start, as plain numbers and names.
struct Read {
  std::map<std::string, std::vector<double>> values;
  std::map<std::string, std::vector<std::string>> names;
  std::string error;
};

std::vector<double> Numbers(const Vector& v) { return {v.x, v.y, v.z}; }
std::vector<double> Numbers(const Placement& p) { return {p.x, p.y, p.z, p.roll, p.pitch, p.yaw}; }

class ReadsAll final : public Behaviour {
 public:
  explicit ReadsAll(Read& read) : read_(read) {}

  base::Status Init(Robot& robot) override {
    const auto open = [&](auto& sensor) -> base::Status {
      using Kind = typename std::remove_reference_t<decltype(sensor)>::element_type;
      auto opened = robot.Open<Kind>(Kind::kType);
      if (!opened) return base::Fail(opened.error());
      sensor = *std::move(opened);
      return {};
    };
    for (const base::Status& status :
         {open(sonar_), open(lidar_), open(position_), open(imu_), open(odometer_),
          open(satellites_), open(magnetometer_), open(altimeter_), open(force_torque_),
          open(bumper_), open(joints_), open(battery_), open(logical_camera_), open(radio_),
          open(ranging_), open(lamp_), open(speaker_), open(gripper_), open(microphone_)}) {
      if (!status) return status;
    }
    const auto wrong = robot.Open<Imu>("sonar");
    if (!wrong) read_.error = wrong.error().message;
    auto created = robot.Create<Sonar>("more", {.x = 0.1, .z = 0.2}, {{"max", 2.0}});
    if (!created) return base::Fail(created.error());
    created_ = *std::move(created);
    return {};
  }

  void Run(Robot& robot) override {
    robot.Drive(1, 0);
    if (const auto sent = radio_->Send("speaker", std::string("\0 me", 4)); !sent) {
      read_.error = sent.error().message;
    }
    const auto refused = radio_->Broadcast(std::string(2000, 'x'));
    // The error sentence for a message that is too long must be the same in all three ways.
    const std::string why = refused ? "" : refused.error().Sentence();
    read_.names["refused"] = {why.substr(std::min(why.size(), why.find("a message of")))};
    for (const base::Status& told :
         {gripper_->Grasp(), lamp_->Set({1, 0.5, 0}, 0.25), speaker_->Play("chirp", 440, 2, 0.5)}) {
      if (!told) read_.error = told.error().message;
    }
    const auto too_bright = lamp_->Set({}, 2);
    const std::string how = too_bright ? "" : too_bright.error().Sentence();
    read_.names["too bright"] = {how.substr(std::min(how.size(), how.find("the brightness")))};
    if (!robot.SleepFor(50ms)) return;
    auto& values = read_.values;
    values["sonar"] = {sonar_->Range(), sonar_->max_range()};
    values["more"] = {created_->Range(), created_->max_range()};
    values["lidar"] = lidar_->Ranges();
    values["lidar intensities"] = lidar_->Read().intensities;
    values["ranging"] = {ranging_->Distance()};
    values["positioning"] = Numbers(position_->Locate());
    const Imu::Motion motion = imu_->Read();
    values["imu"] = Numbers(motion.specific_force);
    const readings::Quaternion turn = motion.world_from_sensor.value();
    values["imu orientation"] = {turn.w, turn.x, turn.y, turn.z};
    const Odometer::Estimate estimate = odometer_->Read();
    values["odometry"] = {estimate.x, estimate.y, estimate.yaw, estimate.linear, estimate.angular};
    const GnssReceiver::Position fix = satellites_->Fix();
    values["navsat"] = {fix.latitude_deg, fix.longitude_deg, fix.altitude, fix.east};
    values["magnetometer"] = Numbers(magnetometer_->Field());
    const Altimeter::Height height = altimeter_->Measured();
    values["altimeter"] = {height.position, height.velocity, height.reference};
    for (const Bumper::Touch& touch : bumper_->Touches()) {
      values["contact"] = Numbers(touch.normal);
      values["contact"].push_back(touch.closing_speed);
      for (const double force : Numbers(touch.force)) values["contact"].push_back(force);
      read_.names["contact"].push_back(touch.other);
    }
    const ForceTorque::Wrench wrench = force_torque_->Read();
    values["force_torque"] = Numbers(wrench.force);
    for (const double torque : Numbers(wrench.torque)) values["force_torque"].push_back(torque);
    for (const JointEncoders::Joint& joint : joints_->Joints()) {
      read_.names["joint_encoders"].push_back(joint.name);
      values["joint_encoders"].push_back(joint.position);
    }
    const Battery::Charge charge = battery_->Level();
    values["battery"] = {charge.voltage, charge.current, charge.charge, charge.fraction};
    for (const LogicalCamera::Sighting& sighting : logical_camera_->Read()) {
      read_.names["logical_camera"].push_back(sighting.name);
      values["logical_camera"] = Numbers(sighting.sensor_from_model);
    }
    for (const Radio::Message& message : radio_->Receive()) {
      read_.names["radio"].push_back(message.sender);
      read_.names["radio"].push_back(message.content);
      values["radio"] = {base::ToSeconds(message.sent), message.strength};
    }
    const Lamp::Glow glow = lamp_->Read();
    values["lamp"] = {glow.brightness, glow.colour.red, glow.colour.green, glow.colour.blue};
    const Gripper::State jaws = gripper_->Read();
    values["gripper"] = {jaws.opening, jaws.told_to_open ? 1.0 : 0.0};
    read_.names["gripper"] = {jaws.held};
    const Speaker::Sound sound = speaker_->Playing();
    values["speaker"] = {sound.frequency, sound.volume, sound.elapsed, sound.left};
    read_.names["speaker"] = {sound.name};
    const Microphone::Hearing hearing = microphone_->Listen();
    values["microphone"] = {hearing.level, hearing.frequency};
    read_.names["microphone"] = {hearing.source};
    values["radio missed"] = {static_cast<double>(radio_->missed()),
                              static_cast<double>(radio_->Receive().size())};
  }

 private:
  Read& read_;
  std::unique_ptr<Sonar> sonar_, created_;
  std::unique_ptr<Lidar> lidar_;
  std::unique_ptr<PositioningSystem> position_;
  std::unique_ptr<Imu> imu_;
  std::unique_ptr<Odometer> odometer_;
  std::unique_ptr<GnssReceiver> satellites_;
  std::unique_ptr<Magnetometer> magnetometer_;
  std::unique_ptr<Altimeter> altimeter_;
  std::unique_ptr<ForceTorque> force_torque_;
  std::unique_ptr<Bumper> bumper_;
  std::unique_ptr<JointEncoders> joints_;
  std::unique_ptr<Battery> battery_;
  std::unique_ptr<LogicalCamera> logical_camera_;
  std::unique_ptr<Radio> radio_;
  std::unique_ptr<Ranging> ranging_;
  std::unique_ptr<Gripper> gripper_;
  std::unique_ptr<Lamp> lamp_;
  std::unique_ptr<Speaker> speaker_;
  std::unique_ptr<Microphone> microphone_;
};

// A disc at the foot of the wall. It has a lever, and one sensor of each type, which is named after
// the type.
simulation::RobotSpecification RobotWithAll(std::shared_ptr<simulation::BehaviourPort> behaviour) {
  auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model->links.push_back({});
  model::Joint lever;
  lever.name = "lever";
  lever.kind = model::JointKind::kRevolute;
  lever.parent = 0;
  lever.child = 1;
  model->joints.push_back(lever);
  model->sensors.clear();
  for (const char* type :
       {"sonar", "lidar", "positioning", "imu", "odometry", "navsat", "magnetometer", "altimeter",
        "contact", "force_torque", "joint_encoders", "battery", "logical_camera", "radio",
        "ranging", "gripper", "lamp", "speaker", "microphone"}) {
    model::SensorDescription sensor;
    sensor.name = sensor.type = type;
    sensor.link_from_sensor.position = {0, 0, 0.25};
    // The sensor is at the height of the wall's centre.
    if (sensor.type == "logical_camera") sensor.link_from_sensor.position.z = 1;
    if (sensor.type == "force_torque") sensor.link = 1;
    if (sensor.type == "lidar") {
      sensor.parameters = {{"scan.horizontal.samples", 8.0}, {"intensity_scale", 100.0}};
    }
    if (sensor.type == "ranging") sensor.parameters = {{"anchor", std::string("speaker")}};
    if (sensor.type == "imu") {
      sensor.parameters = {{"linear_acceleration.x.noise.stddev", 0.1}};
    }
    model->sensors.push_back(sensor);
  }
  simulation::RobotSpecification robot = simulation::Robot("robot", 2.68, 0, std::move(behaviour));
  robot.model = std::move(model);
  return robot;
}

// A robot behind the robot under test. It sends 20 messages at 20 ms. A radio stores only 16
// messages.
simulation::RobotSpecification Speaker() {
  auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
  model::SensorDescription radio;
  radio.name = radio.type = "radio";
  model->sensors.push_back(radio);
  auto behaviour = std::make_shared<simulation::ThreadBehaviour>(
      [](simulation::Agent& agent, simulation::ClockId clock) {
        ASSERT_TRUE(agent.OpenSensor("radio"));
        if (!simulation::SleepFor(agent, clock, 20ms)) return;
        // the encoded bytes of the robot's message "\0 me"
        EXPECT_EQ(agent.Read("radio")->labels->at(1), "ACBtZQ==");
        for (int i = 1; i <= 20; ++i) {
          ASSERT_TRUE(agent.Send("radio", "robot", std::string("\0 word ", 7) + std::to_string(i)));
        }
      });
  simulation::RobotSpecification robot = simulation::Robot("speaker", -2.32, 0, behaviour);
  robot.model = std::move(model);
  return robot;
}

void RunWith(std::shared_ptr<simulation::BehaviourPort> behaviour) {
  auto specification = simulation::Lockstep(100ms);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  world->origin = model::GeodeticOrigin{0.8, 0.1, 50, 0};
  specification.world = world;
  auto simulation = simulation::Make(specification);
  ASSERT_TRUE(simulation->AddRobot(Speaker()));
  ASSERT_TRUE(simulation->AddRobot(RobotWithAll(std::move(behaviour))));
  ASSERT_EQ(simulation::RunToEnd(*simulation), simulation::Phase::kFinished);
}

// Runs the behaviour through the servants of its robot, like a behaviour in another process.
class ThroughCorba final : public simulation::BehaviourPort {
 public:
  using Also = std::function<void(sba::SensorFactory_ptr)>;
  ThroughCorba(PortableServer::POA_ptr poa, std::unique_ptr<Behaviour> behaviour, Also also)
      : group_(std::make_shared<services::ServantGroup>(poa)),
        behaviour_(std::move(behaviour)),
        also_(std::move(also)) {}

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override {
    hardware_ = services::ActivateHardware(agent, group_);
    auto robot = sdk::RemoteRobot::Connect("robot", hardware_);
    if (!robot) return base::Fail(robot.error());
    robot_ = *std::move(robot);
    return behaviour_->Init(*robot_);
  }
  base::Status Start() override {
    if (auto ok = robot_->OpenClock(); !ok) return ok;
    thread_ = std::jthread([this] {
      behaviour_->Run(*robot_);
      const sba::SensorFactory_var factory = hardware_->sensor_factory();
      also_(factory);
      robot_->CloseClock();
    });
    return {};
  }
  base::Status Stop() override {
    robot_->End();
    if (thread_.joinable()) thread_.join();
    return {};
  }
  base::Status Pause() override { return {}; }
  base::Status Resume() override { return {}; }
  void Destroy() override { group_->DeactivateAll(); }
  bool IsDead() override { return false; }
  bool time_managed() const override { return true; }
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return name_; }

 private:
  const std::string name_ = "test";
  const std::shared_ptr<services::ServantGroup> group_;
  const std::unique_ptr<Behaviour> behaviour_;
  const Also also_;
  sba::Hardware_var hardware_;
  std::shared_ptr<sdk::RemoteRobot> robot_;
  std::jthread thread_;
};

template <typename Interface>
typename Interface::_var_type Opened(sba::SensorFactory_ptr factory, const char* name) {
  const sba::Sensor_var sensor = factory->open(name);
  auto narrowed = Interface::_narrow(sensor);
  EXPECT_FALSE(CORBA::is_nil(narrowed)) << name;
  return narrowed;
}

// Compares the values with the values from the IDL interface of each sensor type.
void CheckInterfaces(sba::SensorFactory_ptr factory, const Read& read) {
  const auto& values = read.values;
  EXPECT_EQ(Opened<sba::Sonar>(factory, "sonar")->range(), values.at("sonar")[0]);
  const sba::Doubles_var ranges = Opened<sba::Lidar>(factory, "lidar")->ranges();
  EXPECT_EQ(ranges->length(), values.at("lidar").size());
  const sba::LidarScan_var scan = Opened<sba::IntensityLidar>(factory, "lidar")->read();
  EXPECT_EQ(scan->time_ns, 50'000'000);
  ASSERT_EQ(scan->ranges_m.length(), values.at("lidar").size());
  ASSERT_EQ(scan->intensities.length(), values.at("lidar intensities").size());
  EXPECT_EQ(scan->intensities[0], values.at("lidar intensities")[0]);
  const sba::RangingReading ranged = Opened<sba::Ranging>(factory, "ranging")->read();
  EXPECT_EQ(ranged.time_ns, 50'000'000);
  EXPECT_EQ(ranged.distance_m, values.at("ranging")[0]);
  EXPECT_EQ(Opened<sba::PositioningSystem>(factory, "positioning")->locate().x_m,
            values.at("positioning")[0]);
  const sba::ImuReading felt = Opened<sba::Imu>(factory, "imu")->feel();
  EXPECT_EQ(felt.specific_force_m_s2.x, values.at("imu")[0]);
  EXPECT_EQ(felt.time_ns, 50'000'000);
  const sba::OrientedImuReading oriented = Opened<sba::Imu>(factory, "imu")->read();
  EXPECT_EQ(oriented.specific_force_m_s2.x, values.at("imu")[0]);
  EXPECT_TRUE(oriented.has_orientation);
  const sba::Rotation& q = oriented.world_from_sensor;
  EXPECT_EQ(std::vector<double>({q.w, q.x, q.y, q.z}), values.at("imu orientation"));
  EXPECT_EQ(Opened<sba::Odometer>(factory, "odometry")->reckon().x_m, values.at("odometry")[0]);
  EXPECT_EQ(Opened<sba::SatelliteReceiver>(factory, "navsat")->fix().latitude_deg,
            values.at("navsat")[0]);
  EXPECT_EQ(Opened<sba::Magnetometer>(factory, "magnetometer")->field_t().z,
            values.at("magnetometer")[2]);
  EXPECT_EQ(Opened<sba::Altimeter>(factory, "altimeter")->height().reference_m,
            values.at("altimeter")[2]);
  EXPECT_TRUE(Opened<sba::Bumper>(factory, "contact")->is_pressed());
  const sba::TouchPoints_var touches = Opened<sba::Bumper>(factory, "contact")->touches();
  ASSERT_EQ(touches->length(), 1u);
  EXPECT_STREQ(touches.in()[0].other, "wall");
  EXPECT_EQ(touches.in()[0].closing_speed_m_s, values.at("contact")[3]);
  const sba::PressedPoints_var presses = Opened<sba::Bumper>(factory, "contact")->presses();
  ASSERT_EQ(presses->length(), 1u);
  EXPECT_EQ(presses.in()[0].closing_speed_m_s, values.at("contact")[3]);
  EXPECT_EQ(presses.in()[0].force_n.x, values.at("contact")[4]);
  const sba::ForceTorqueReading wrench =
      Opened<sba::ForceTorque>(factory, "force_torque")->wrench();
  EXPECT_EQ(wrench.force_n.z, values.at("force_torque")[2]);
  EXPECT_EQ(wrench.torque_n_m.y, values.at("force_torque")[4]);
  const sba::EncoderReadings_var joints =
      Opened<sba::JointEncoders>(factory, "joint_encoders")->joints();
  ASSERT_EQ(joints->length(), 1u);
  EXPECT_STREQ(joints.in()[0].joint, "lever");
  EXPECT_EQ(Opened<sba::Battery>(factory, "battery")->level().charge_ah, values.at("battery")[2]);
  const sba::Sightings_var sightings =
      Opened<sba::LogicalCamera>(factory, "logical_camera")->look();
  ASSERT_EQ(sightings->length(), 1u);
  EXPECT_STREQ(sightings.in()[0].name, "wall");
  const sba::Radio_var radio = Opened<sba::Radio>(factory, "radio");
  const sba::RadioMessages_var heard = radio->receive(18);
  ASSERT_EQ(heard->length(), 2u);
  EXPECT_STREQ(heard.in()[1].sender, "speaker");
  EXPECT_EQ(heard.in()[1].number, 20u);
  EXPECT_EQ(heard.in()[1].sent_ns, 20'000'000);
  EXPECT_EQ(heard.in()[1].strength_dbm, values.at("radio")[1]);
  EXPECT_EQ(heard.in()[1].content.length(), 9u);
  EXPECT_THROW(radio->send("", sba::Octets(2000, 2000, sba::Octets::allocbuf(2000), true)),
               sba::Refused);
  const sba::Lamp_var lamp = Opened<sba::Lamp>(factory, "lamp");
  EXPECT_EQ(lamp->look().brightness, values.at("lamp")[0]);
  EXPECT_EQ(lamp->look().colour.green, values.at("lamp")[2]);
  EXPECT_THROW(lamp->shine(1, {0, -1, 0}), sba::Refused);
  lamp->switch_off();
  const sba::Gripper_var gripper = Opened<sba::Gripper>(factory, "gripper");
  EXPECT_EQ(sba::GripperReading_var(gripper->feel())->opening_m, values.at("gripper")[0]);
  gripper->let_go();
  gripper->grip();
  const sba::Speaker_var speaker = Opened<sba::Speaker>(factory, "speaker");
  const sba::SpeakerReading_var playing = speaker->playing();
  EXPECT_STREQ(playing->sound, "chirp");
  EXPECT_EQ(playing->left_s, values.at("speaker")[3]);
  EXPECT_THROW(speaker->play("song", 440, 1, 1), sba::Refused);
  speaker->silence();
  const sba::Hearing_var hearing = Opened<sba::Microphone>(factory, "microphone")->listen();
  EXPECT_EQ(hearing->level_db, values.at("microphone")[0]);
  EXPECT_STREQ(hearing->source, "robot/speaker");
}

TEST(Sensors, ReadTheSameInProcessThroughCorbaAndThroughTheirInterfaces) {
  Read local, remote;
  RunWith(std::make_shared<hosting::HostedBehaviour>(
      "reader", [&] { return std::make_unique<ReadsAll>(local); }));
  auto orb = orb::StartOrb({});
  ASSERT_TRUE(orb) << orb.error().Sentence();
  {
    const PortableServer::POA_var poa = orb::RootPoa(*orb);
    RunWith(std::make_shared<ThroughCorba>(
        poa, std::make_unique<ReadsAll>(remote),
        [&](sba::SensorFactory_ptr factory) { CheckInterfaces(factory, remote); }));
  }
  (*orb)->destroy();
  EXPECT_EQ(local.values, remote.values);
  EXPECT_EQ(local.names, remote.names);
  EXPECT_EQ(local.values.size(), 23u);

  const auto& values = local.values;
  EXPECT_EQ(values.at("more")[1], 2);
  EXPECT_NEAR(values.at("sonar")[0], 0.2, 1e-3);  // the robot is at the wall
  EXPECT_EQ(values.at("sonar")[1], 5);
  EXPECT_EQ(values.at("lidar").size(), 8u);
  EXPECT_EQ(values.at("lidar intensities").size(), 8u);
  // The other robot is 5.02 m behind, and the tag 0.25 m above its own robot.
  EXPECT_NEAR(values.at("ranging")[0], std::hypot(5.02, 0.25), 1e-3);
  EXPECT_NEAR(values.at("altimeter")[2], 0.25, 1e-9);
  EXPECT_GT(values.at("navsat")[0], 45);
  EXPECT_NEAR(values.at("force_torque")[2], -9.8, 1e-9);  // weight of the 1 kg lever
  EXPECT_EQ(local.names.at("contact"), std::vector<std::string>{"wall"});
  EXPECT_EQ(values.at("radio")[0], 0.02);
  EXPECT_EQ(values.at("radio missed"), (std::vector<double>{4, 0}));
  ASSERT_EQ(local.names.at("radio").size(), 32u);
  EXPECT_EQ(local.names.at("radio").back(), std::string("\0 word 20", 9));
  EXPECT_EQ(local.names.at("refused").front(),
            "a message of 2000 bytes is longer than the radio's max_size, 1024");
  EXPECT_EQ(values.at("lamp"), (std::vector<double>{0.25, 1, 0.5, 0}));
  EXPECT_EQ(values.at("speaker"), (std::vector<double>{440, 0.5, 0.05, 1.95}));
  EXPECT_EQ(local.names.at("speaker").front(), "chirp");
  EXPECT_NEAR(values.at("gripper")[0], 0.09, 1e-12);
  EXPECT_EQ(values.at("gripper")[1], 0);
  EXPECT_EQ(values.at("microphone")[1], 440);
  EXPECT_EQ(local.names.at("too bright").front(),
            "the brightness is 2; it must lie between 0 and 1");
  EXPECT_EQ(local.error, "the sensor \"sonar\" is no imu");
  EXPECT_EQ(remote.error, "the sensor \"sonar\" is no imu");
}

// Runs the behaviour on a disc with the sensor, in process and through CORBA. `make` makes a new
// behaviour for each.
void RunBothWays(const model::SensorDescription& sensor,
                 const std::shared_ptr<sensing::SensorRegistry>& types,
                 const std::function<std::unique_ptr<Behaviour>()>& make,
                 const ThroughCorba::Also& also) {
  const auto run = [&](std::shared_ptr<simulation::BehaviourPort> behaviour) {
    auto simulation = simulation::Simulation::Create(simulation::Lockstep(100ms), types);
    ASSERT_TRUE(simulation);
    auto model = std::make_shared<model::Model>(*simulation::Disc(0.2));
    model->sensors = {sensor};
    simulation::RobotSpecification robot = simulation::Robot("robot", 0, 0, std::move(behaviour));
    robot.model = std::move(model);
    ASSERT_TRUE((*simulation)->AddRobot(robot));
    (void)simulation::RunToEnd(**simulation);
  };
  run(std::make_shared<hosting::HostedBehaviour>("tested", make));
  auto orb = orb::StartOrb({});
  ASSERT_TRUE(orb) << orb.error().Sentence();
  {
    const PortableServer::POA_var poa = orb::RootPoa(*orb);
    run(std::make_shared<ThroughCorba>(poa, make(), also));
  }
  (*orb)->destroy();
}

// A sensor with four values, where an IMU has six or ten.
class BrokenImu final : public sensing::Sensor {
 public:
  using Sensor::Sensor;
  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    sensing::Reading reading = sampling.Stamped();
    reading.values = {1, 2, 3, 4};
    return reading;
  }
};

TEST(Sensors, ReadingOfTheWrongSizeEndsTheRunWithAnErrorThatNamesTheSensor) {
  auto types = std::make_shared<sensing::SensorRegistry>();
  sensing::SensorType imu;
  imu.name = "imu";
  imu.create = [](const model::SensorDescription& description) {
    return base::Result<std::unique_ptr<sensing::Sensor>>(std::make_unique<BrokenImu>(description));
  };
  ASSERT_TRUE(types->Add(std::move(imu)));
  std::vector<std::string> errors;
  class Feels final : public Behaviour {
   public:
    explicit Feels(std::vector<std::string>& errors) : errors_(errors) {}
    base::Status Init(gsv::Robot& robot) override {
      auto opened = robot.Open<Imu>("skewed");
      if (!opened) return base::Fail(opened.error());
      imu_ = *std::move(opened);
      return {};
    }
    void Run(gsv::Robot& robot) override {
      (void)imu_->Read();
      EXPECT_FALSE(robot.IsRunning());
      errors_.push_back(robot.error());
    }

   private:
    std::vector<std::string>& errors_;
    std::unique_ptr<Imu> imu_;
  };
  RunBothWays(
      {.name = "skewed", .type = "imu"}, types, [&] { return std::make_unique<Feels>(errors); },
      [](sba::SensorFactory_ptr factory) {
        EXPECT_THROW(Opened<sba::Imu>(factory, "skewed")->feel(), sba::Failed);
      });
  EXPECT_EQ(errors, std::vector<std::string>(2,
                                             "skewed: a reading has the wrong size: expected 6 "
                                             "or 10 values, found 4 values and 0 labels"));
}

TEST(Sensors, SidewaysMotionIsCommandedAndReadBack) {
  auto types = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*types);
  std::vector<Odometer::Estimate> estimates;
  class Sidles final : public Behaviour {
   public:
    explicit Sidles(std::vector<Odometer::Estimate>& estimates) : estimates_(estimates) {}
    base::Status Init(gsv::Robot& robot) override {
      auto opened = robot.Open<Odometer>("wheels");
      if (!opened) return base::Fail(opened.error());
      odometer_ = *std::move(opened);
      return {};
    }
    void Run(gsv::Robot& robot) override {
      robot.DriveSideways(0.25, 0.5, 0);
      if (!robot.SleepFor(40ms)) return;
      estimates_.push_back(odometer_->Read());
      std::vector<Reading> readings;
      robot.Exchange({.linear = 0, .lateral = -1}, robot.Now() + 20ms, readings);
      estimates_.push_back(odometer_->Read());
    }

   private:
    std::vector<Odometer::Estimate>& estimates_;
    std::unique_ptr<Odometer> odometer_;
  };
  RunBothWays(
      {.name = "wheels", .type = "odometry"}, types,
      [&] { return std::make_unique<Sidles>(estimates); },
      [](sba::SensorFactory_ptr factory) {
        const auto read = Opened<sba::Odometer>(factory, "wheels")->read();
        EXPECT_EQ(read.lateral_m_s, -1);
        EXPECT_EQ(read.linear_m_s, 0);
      });
  ASSERT_EQ(estimates.size(), 4u);
  for (std::size_t i = 0; i < estimates.size(); i += 2) {
    const Odometer::Estimate &first = estimates[i], &second = estimates[i + 1];
    EXPECT_EQ(first.lateral, 0.5);
    EXPECT_EQ(first.linear, 0.25);
    EXPECT_NEAR(first.y, 0.5 * 0.04, 1e-12);
    EXPECT_NEAR(first.x, 0.25 * 0.04, 1e-12);
    EXPECT_EQ(second.lateral, -1);
    EXPECT_NEAR(second.y, 0.5 * 0.04 - 0.02, 1e-12);
  }
}

}  // namespace
}  // namespace gsv
