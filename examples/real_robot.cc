// A robot that implements sba::Hardware without a simulator. It finds a behaviour at the broker,
// gives it its own hardware, and lets it drive for a while.
//
// Its "hardware" is a cart on a straight track in front of a wall, in wall-clock time: the sonar
// measures the remaining distance. A real robot's driver would read its devices here.
//
//   gsv-wander --broker REF &
//   example-real-robot --broker REF
//
// Exits with 0 if the behaviour read the sonar, drove, and stayed away from the wall, else with 1.
// Exits with 2 after a usage error, and with 5 if the behaviour cannot be called.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>

#include <CLI/CLI.hpp>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"
#include "idl/behaviour.hh"

namespace {

using namespace gsv;
using Clock = std::chrono::steady_clock;

constexpr double kRadius = 0.2;         // m
constexpr double kMaxRange = 5.0;       // m
constexpr double kStartDistance = 1.5;  // distance from the wall, m

double Seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

// The cart. It moves towards the wall while it faces the wall.
class Cart {
 public:
  void Drive(double linear, double angular) {
    const std::lock_guard lock(mutex_);
    Advance();
    linear_ = linear, angular_ = angular;
    ++commands_;
  }
  // The reading of a sonar that points to `bearing` from straight ahead.
  double Range(double bearing) {
    const std::lock_guard lock(mutex_);
    Advance();
    ++readings_;
    const double towards_wall = std::cos(heading_ + bearing);
    return towards_wall > 0.05 ? std::min(kMaxRange, (kStartDistance - x_) / towards_wall)
                               : kMaxRange;
  }
  std::int64_t Now() const { return std::chrono::nanoseconds(Clock::now() - start_).count(); }
  void WaitUntil(std::int64_t instant) const {
    std::unique_lock lock(mutex_);
    ended_changed_.wait_until(lock, start_ + std::chrono::nanoseconds(instant),
                              [this] { return ended_; });
  }
  void End() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    ended_changed_.notify_all();
  }
  void CheckAlive() const {
    const std::lock_guard lock(mutex_);
    if (ended_) throw sba::Ended("the robot is shutting down");
  }
  double travelled() const { return travelled_; }
  double nearest_to_wall() const { return nearest_; }
  int commands() const { return commands_; }
  int readings() const { return readings_; }

 private:
  void Advance() {
    const auto now = Clock::now();
    const double dt = Seconds(now - last_);
    last_ = now;
    heading_ += angular_ * dt;
    x_ += linear_ * std::cos(heading_) * dt;
    travelled_ += std::abs(linear_) * dt;
    nearest_ = std::min(nearest_, kStartDistance - x_);
  }

  mutable std::mutex mutex_;
  mutable std::condition_variable ended_changed_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  bool ended_ = false;
  double x_ = 0, heading_ = 0, linear_ = 0, angular_ = 0;
  double travelled_ = 0, nearest_ = kStartDistance;
  int commands_ = 0, readings_ = 0;
};

sba::Measurement Measured(const std::string& name, double value, std::int64_t now) {
  sba::Measurement measurement;
  measurement.sensor_name = name.c_str();
  measurement.time_ns = now;
  measurement.values.length(1);
  measurement.values[0] = value;
  measurement.image_width = measurement.image_height = 0;
  return measurement;
}

// The object adapter owns the created objects until the program ends.
template <class Servant>
auto HandedOut(PortableServer::Servant_var<Servant> servant) {
  return servant->_this();
}

class CartSonar final : public POA_sba::Sonar {
 public:
  CartSonar(Cart& cart, std::string name, double bearing)
      : cart_(cart), name_(std::move(name)), bearing_(bearing) {}
  sba::SensorTraits* traits() override {
    auto* traits = new sba::SensorTraits;
    traits->name = name_.c_str();
    traits->type = "sonar";
    traits->mounting = {0, 0, 0, 0, 0, bearing_};
    traits->update_rate_hz = 0;
    return traits;
  }
  sba::Measurement* measure() override {
    return new sba::Measurement(Measured(name_, range(), cart_.Now()));
  }
  void close() override {}
  CORBA::Double range() override {
    cart_.CheckAlive();
    return cart_.Range(bearing_);
  }
  CORBA::Double max_range() override { return kMaxRange; }

 private:
  Cart& cart_;
  const std::string name_;
  const double bearing_;
};

// The cart has no built-in sensors. Only sonars can be created.
class CartSensors final : public POA_sba::SensorFactory {
 public:
  explicit CartSensors(Cart& cart) : cart_(cart) {}
  sba::SensorTraitsList* list() override { return new sba::SensorTraitsList; }
  sba::Strings* types() override {
    auto* types = new sba::Strings;
    types->length(1);
    (*types)[0] = "sonar";
    return types;
  }
  sba::Sensor_ptr open(const char*) override {
    throw sba::Refused("this robot has no sensors built in");
  }
  sba::Sonar_ptr create_sonar(const char* name, const sba::Placement& mounting, CORBA::Double,
                              CORBA::Double) override {
    return HandedOut<CartSonar>(new CartSonar(cart_, name, mounting.yaw_rad));
  }
  sba::Camera_ptr create_camera(const char*, const sba::Placement&, CORBA::ULong, CORBA::ULong,
                                CORBA::Double) override {
    throw sba::Refused("this robot has no camera");
  }
  sba::PositioningSystem_ptr create_positioning_system(const char*) override {
    throw sba::Refused("this robot has no positioning system");
  }
  sba::Sensor_ptr create(const char* type, const sba::SensorTraits& description) override {
    if (std::string_view(type) != "sonar") throw sba::Refused("sonars only");
    return create_sonar(description.name, description.mounting, 0, kMaxRange);
  }

 private:
  Cart& cart_;
};

class CartBase final : public POA_sba::ActuatorProxy {
 public:
  explicit CartBase(Cart& cart) : cart_(cart) {}
  void drive(CORBA::Double linear_m_s, CORBA::Double angular_rad_s) override {
    cart_.CheckAlive();
    cart_.Drive(linear_m_s, angular_rad_s);
  }
  void drive_sideways(CORBA::Double, CORBA::Double, CORBA::Double) override {
    throw sba::Refused("this base cannot move sideways");
  }
  void halt() override { cart_.Drive(0, 0); }

 private:
  Cart& cart_;
};

class CartClock final : public POA_sba::Clock {
 public:
  explicit CartClock(Cart& cart) : cart_(cart) {}
  CORBA::LongLong now() override { return cart_.Now(); }
  sba::WaitOutcome sleep_until(CORBA::LongLong instant) override {
    const std::int64_t lease_ends = cart_.Now() + 2'000'000'000;
    cart_.WaitUntil(std::min<std::int64_t>(instant, lease_ends));
    cart_.CheckAlive();
    return instant <= cart_.Now() ? sba::REACHED : sba::NOT_YET;
  }
  sba::WaitOutcome exchange(CORBA::ULongLong, const sba::BaseCommand& command,
                            CORBA::LongLong instant, CORBA::LongLong& reached_ns,
                            sba::Measurements_out readings) override {
    if (command.given) cart_.Drive(command.linear_m_s, command.angular_rad_s);
    readings = new sba::Measurements;
    const sba::WaitOutcome outcome = sleep_until(instant);
    reached_ns = cart_.Now();
    return outcome;
  }
  void close() override {}
  void give_up(const char* reason) override {
    cart_.Drive(0, 0);
    std::fprintf(stderr, "the behaviour failed: %.200s\n", reason);
  }

 private:
  Cart& cart_;
};

class CartHardware final : public POA_sba::Hardware {
 public:
  explicit CartHardware(Cart& cart)
      : cart_(cart), sensors_(new CartSensors(cart)), base_(new CartBase(cart)) {}
  char* robot_name() override { return CORBA::string_dup("cart"); }
  char* robot_model() override { return CORBA::string_dup("cart"); }
  CORBA::Double footprint_radius_m() override { return kRadius; }
  sba::SensorFactory_ptr sensor_factory() override { return sensors_->_this(); }
  sba::ActuatorProxy_ptr base() override { return base_->_this(); }
  sba::Clock_ptr open_clock() override { return HandedOut<CartClock>(new CartClock(cart_)); }

 private:
  Cart& cart_;
  PortableServer::Servant_var<CartSensors> sensors_;
  PortableServer::Servant_var<CartBase> base_;
};

base::Status DriveFor(double seconds, CORBA::ORB_ptr orb, const std::string& broker_reference,
                      const std::string& behaviour_name, Cart& cart) {
  auto broker = broker::BrokerClient::Connect(orb, broker_reference);
  if (!broker) return base::Fail(broker.error());
  auto offers = broker->Query(broker::AgentBehaviourFactoryType().name,
                              "name == '" + behaviour_name + "'", "first", 1);
  if (!offers) return base::Fail(offers.error());
  if (offers->empty()) {
    return base::Fail(base::ErrorCode::kNotFound, "the broker does not offer the behaviour",
                      broker->reference());
  }
  // The ORB keeps its servants until it is destroyed.
  const PortableServer::Servant_var<CartHardware> hardware(new CartHardware(cart));
  const auto status = orb::Call(behaviour_name, [&] {
    const sba::AgentBehaviourFactory_var factory =
        sba::AgentBehaviourFactory::_narrow(offers->front().object);
    const sba::AgentBehaviour_var behaviour = factory->create();
    const sba::Hardware_var reference = hardware->_this();
    behaviour->init("cart", reference);
    behaviour->start();
    cart.WaitUntil(cart.Now() + static_cast<std::int64_t>(seconds * 1e9));
    cart.End();
    behaviour->stop();
    behaviour->destroy();
  });
  if (!status) return base::Fail(status.error());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  std::string broker, behaviour = "wander";
  double seconds = 3;
  CLI::App app("Drives a robot outside of the simulator with a behaviour from the broker.");
  app.add_option("--broker", broker)->envname("GSV_BROKER")->required();
  app.add_option("--behaviour", behaviour)->capture_default_str();
  app.add_option("--seconds", seconds)->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  auto orb = orb::StartOrb({});
  Cart cart;
  const base::Status status =
      orb ? DriveFor(seconds, *orb, broker, behaviour, cart) : base::Fail(orb.error());
  if (orb) (*orb)->destroy();
  if (!status) {
    std::fprintf(stderr, "%s\n", status.error().Sentence().c_str());
    return 5;
  }
  std::printf("%d readings, %d commands, %.2f m travelled, minimum distance to the wall %.2f m\n",
              cart.readings(), cart.commands(), cart.travelled(), cart.nearest_to_wall());
  return cart.readings() > 0 && cart.commands() > 0 && cart.travelled() > 0.05 &&
                 cart.nearest_to_wall() > kRadius
             ? 0
             : 1;
}
