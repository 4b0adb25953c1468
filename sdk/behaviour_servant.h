// The servants of a behaviour program: sba::AgentBehaviour for a gsv::Behaviour, and the factory
// that creates an sba::AgentBehaviour for each robot.
//
// Threads  ORB threads make the calls; the behaviour runs on its own thread.
#pragma once

#include <thread>

#include "gsv/base/mutex.h"

#include "idl/behaviour.hh"
#include "sdk/behaviour/behaviour.h"
#include "sdk/remote_robot.h"

namespace gsv::sdk {

// One behaviour, which the simulation calls for its robot.
class BehaviourServant final : public POA_sba::AgentBehaviour {
 public:
  BehaviourServant(PortableServer::POA_ptr poa, BehaviourFactory factory);
  ~BehaviourServant() override;

  void init(const char* agent_name, sba::Hardware_ptr robot) override;
  void start() override;
  void stop() override;
  void pause() override;
  void resume() override;
  void destroy() override;

 private:
  // Ends the behaviour's run in this process, and waits for the behaviour's thread.
  void EndRun() GSV_REQUIRES(mutex_);

  PortableServer::POA_var poa_;
  const BehaviourFactory factory_;
  base::Mutex mutex_;
  // The robot of the last init(); null before it.
  std::shared_ptr<RemoteRobot> robot_ GSV_GUARDED_BY(mutex_);
  // The behaviour of the last init(); null before it.
  std::unique_ptr<Behaviour> behaviour_ GSV_GUARDED_BY(mutex_);
  std::jthread running_;  // the thread that executes Behaviour::Run()
};

// Creates a behaviour that the POA owns until its destroy() is called.
sba::AgentBehaviour_ptr NewBehaviour(PortableServer::POA_ptr poa, BehaviourFactory factory);

// The object behind a program's offer. It makes a behaviour for each robot.
class BehaviourFactoryServant final : public POA_sba::AgentBehaviourFactory {
 public:
  BehaviourFactoryServant(PortableServer::POA_ptr poa, BehaviourFactory factory);

  sba::AgentBehaviour_ptr create() override;

 private:
  PortableServer::POA_var poa_;
  const BehaviourFactory factory_;
};

}  // namespace gsv::sdk
