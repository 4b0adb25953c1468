#include "gsv/services/remote_behaviour.h"

#include <chrono>

#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"

namespace gsv::services {
namespace {

// Time limit of a call to a behaviour, in wall-clock time. init() may read files.
constexpr std::chrono::milliseconds kCallTimeout = StopTimeout::kNormal;
constexpr std::chrono::milliseconds kPingTimeout{1500};

// Sets the time limit of all remote calls of this thread, during the lifetime of this object.
class ThreadTimeout {
  // The ORB stores the limit in an omni_thread object for each thread. This member makes such an
  // object for a std::thread.
  omni_thread::ensure_self self_;

 public:
  explicit ThreadTimeout(std::chrono::milliseconds limit) {
    omniORB::setClientThreadCallTimeout(static_cast<CORBA::ULong>(limit.count()));
  }
  ~ThreadTimeout() { omniORB::setClientThreadCallTimeout(0); }
};

}  // namespace

RemoteBehaviour::RemoteBehaviour(sba::AgentBehaviour_ptr behaviour, BehaviourIdentity identity,
                                 PortableServer::POA_ptr poa,
                                 std::shared_ptr<const StopTimeout> stop_timeout)
    : identity_(std::move(identity)),
      behaviour_(sba::AgentBehaviour::_duplicate(behaviour)),
      poa_(PortableServer::POA::_duplicate(poa)),
      stop_timeout_(stop_timeout != nullptr ? std::move(stop_timeout)
                                            : std::make_shared<const StopTimeout>()) {
  orb::LimitCalls(behaviour_, kCallTimeout);
}

RemoteBehaviour::~RemoteBehaviour() { ReplaceHardware(nullptr); }

void RemoteBehaviour::ReplaceHardware(std::shared_ptr<ServantGroup> hardware) {
  {
    const base::MutexLock lock(mutex_);
    hardware_.swap(hardware);
  }
  if (hardware != nullptr) hardware->DeactivateAll();
}

template <typename Function>
base::Status RemoteBehaviour::Call(const char* operation, Function call) const {
  auto status = orb::Call(identity_.name + " on " + identity_.place, call);
  if (status) return {};
  base::Error error = status.error();
  error.code = base::ErrorCode::kBehaviour;
  error.message = std::string(operation) + ": " + error.message;
  return base::Fail(std::move(error));
}

base::Status RemoteBehaviour::Init(const std::shared_ptr<simulation::Agent>& agent) {
  auto hardware = std::make_shared<ServantGroup>(poa_);
  ReplaceHardware(hardware);
  const sba::Hardware_var reference = ActivateHardware(agent, std::move(hardware));
  return Call("init", [&] { behaviour_->init(agent->robot().c_str(), reference); });
}

base::Status RemoteBehaviour::Start() {
  return Call("start", [this] { behaviour_->start(); });
}

base::Status RemoteBehaviour::Stop() {
  // Changes the time limit of calls through this reference. A limit of the thread would have no
  // effect, because omniORB prefers the limit of the reference.
  orb::LimitCalls(behaviour_, stop_timeout_->limit());
  auto stopped = Call("stop", [this] { behaviour_->stop(); });
  orb::LimitCalls(behaviour_, kCallTimeout);
  has_not_stopped_ = !stopped;
  return stopped;
}

base::Status RemoteBehaviour::Pause() {
  return Call("pause", [this] { behaviour_->pause(); });
}

base::Status RemoteBehaviour::Resume() {
  return Call("resume", [this] { behaviour_->resume(); });
}

void RemoteBehaviour::Destroy() {
  // This process is ending, and the behaviour did not answer stop(). Then destroy() is not called,
  // because the call would only wait for its time limit.
  const bool is_of_no_use = has_not_stopped_ && stop_timeout_->is_shortened();
  if (!is_of_no_use) {
    orb::LimitCalls(behaviour_, stop_timeout_->limit());
    // the call may fail, because the behaviour may have ended
    (void)Call("destroy", [this] { behaviour_->destroy(); });
  }
  ReplaceHardware(nullptr);
}

bool RemoteBehaviour::IsDead() {
  const ThreadTimeout timeout(kPingTimeout);
  // The call is repeated once. A broken connection does not prove that the process has died,
  // because the process may accept a new connection.
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      return behaviour_->_non_existent();
    } catch (const CORBA::SystemException& exception) {
      if (orb::MeansGone(exception)) return true;
      if (CORBA::COMM_FAILURE::_downcast(&exception) == nullptr) return false;
    }
  }
  return false;
}

}  // namespace gsv::services
