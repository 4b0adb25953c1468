#include "sdk/behaviour_servant.h"

#include <exception>

#include "gsv/base/log.h"
#include "gsv/orb/errors.h"
#include "sdk/behaviour/run.h"

namespace gsv::sdk {
namespace {

// Runs the behaviour on its own thread. An exception of the behaviour ends its run, not the
// program.
void RunOnClock(Behaviour& behaviour, RemoteRobot& robot) {
  const RunFailure failure = RunToItsEnd(behaviour, robot);
  if (failure.empty()) return robot.CloseClock();
  spdlog::error("{}", failure.LogText(robot.name()));
  robot.GiveUp(failure.cause);
}

}  // namespace

BehaviourServant::BehaviourServant(PortableServer::POA_ptr poa, BehaviourFactory factory)
    : poa_(PortableServer::POA::_duplicate(poa)), factory_(std::move(factory)) {}

BehaviourServant::~BehaviourServant() {
  const base::MutexLock lock(mutex_);
  EndRun();
}

void BehaviourServant::init(const char* agent_name, sba::Hardware_ptr hardware) {
  const base::MutexLock lock(mutex_);
  EndRun();
  behaviour_.reset();
  robot_ = orb::ValueOrThrow(RemoteRobot::Connect(agent_name, hardware));
  std::unique_ptr<Behaviour> behaviour;
  base::Status initialised;
  try {
    behaviour = factory_();
    initialised = behaviour->Init(*robot_);
  } catch (const std::exception& exception) {
    throw sba::Failed((std::string("the behaviour threw in Init: ") + exception.what()).c_str());
  }
  orb::ValueOrThrow(std::move(initialised));
  behaviour_ = std::move(behaviour);
}

void BehaviourServant::start() {
  const base::MutexLock lock(mutex_);
  if (behaviour_ == nullptr) throw sba::Refused("call init before start");
  if (running_.joinable()) throw sba::Refused("the behaviour is running already");
  orb::ValueOrThrow(robot_->OpenClock());
  // The behaviour and the robot outlive the thread, because EndRun() joins the thread before either
  // is replaced.
  running_ =
      std::jthread([&behaviour = *behaviour_, &robot = *robot_] { RunOnClock(behaviour, robot); });
}

void BehaviourServant::stop() {
  const base::MutexLock lock(mutex_);
  EndRun();
}

void BehaviourServant::EndRun() {
  if (robot_ != nullptr) robot_->End();
  if (running_.joinable()) running_.join();
  running_ = {};
}

void BehaviourServant::pause() {
  const base::MutexLock lock(mutex_);
  if (behaviour_ != nullptr) behaviour_->Paused();
}

void BehaviourServant::resume() {
  const base::MutexLock lock(mutex_);
  if (behaviour_ != nullptr) behaviour_->Resumed();
}

void BehaviourServant::destroy() {
  {
    const base::MutexLock lock(mutex_);
    EndRun();
  }
  const PortableServer::ObjectId_var id = poa_->servant_to_id(this);
  poa_->deactivate_object(id);
}

sba::AgentBehaviour_ptr NewBehaviour(PortableServer::POA_ptr poa, BehaviourFactory factory) {
  PortableServer::Servant_var<BehaviourServant> servant(
      new BehaviourServant(poa, std::move(factory)));
  const PortableServer::ObjectId_var id = poa->activate_object(servant);
  return servant->_this();
}

BehaviourFactoryServant::BehaviourFactoryServant(PortableServer::POA_ptr poa,
                                                 BehaviourFactory factory)
    : poa_(PortableServer::POA::_duplicate(poa)), factory_(std::move(factory)) {}

sba::AgentBehaviour_ptr BehaviourFactoryServant::create() { return NewBehaviour(poa_, factory_); }

}  // namespace gsv::sdk
