// The CORBA servants of sba::Simulation and sba::SimulationService, for the simulations of a
// SimulationHost.
//
// Threads  ORB threads.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/services/behaviour_source.h"
#include "gsv/services/simulation_host.h"
#include "idl/simulation.hh"

namespace gsv::services {

// Functions of the program that the services call.
struct ServiceHooks {
  // Returns the file of a world. An empty name means the default world. The function may be empty.
  std::function<base::Result<std::string>(const std::string& world)> find_world;
  // Returns the URL of a simulation's viewer; may be empty.
  std::function<std::string(const std::string& simulation)> viewer_url;
  // Start and stop the recording of a simulation; may be empty.
  std::function<base::Status(std::shared_ptr<simulation::Simulation>, const std::string& path)>
      start_recording;
  std::function<base::Status(const std::string& simulation)> stop_recording;
};

class SimulationServiceServant;

// One simulation, as a CORBA object.
class SimulationServant final : public POA_sba::Simulation {
 public:
  SimulationServant(std::shared_ptr<simulation::Simulation> simulation,
                    SimulationServiceServant& service, sba::SimulationSpecification specification);

  sba::SimulationSpecification* specification() override;
  char* add_robot(const sba::RobotSpecification& robot) override;
  char* add_avatar(const sba::RobotSpecification& avatar) override;
  void remove_robot(const char* name) override;
  void start() override;
  void pause() override;
  void resume() override;
  void step(CORBA::ULongLong count) override;
  void run_until(CORBA::LongLong instant) override;
  void set_factor(CORBA::Double factor) override;
  void stop() override;
  void reset() override;
  sba::SimulationState* state() override;
  sba::RobotHealths* health() override;
  sba::OutputLines* output(const char* robot) override;
  sba::SimulationPhase await_change(sba::SimulationPhase known) override;
  char* state_hash() override;
  char* viewer_url() override;
  sba::CommandDescriptions* commands() override;
  void command(const char* name, const sba::NameValues& arguments) override;
  void start_recording(const char* path) override;
  void stop_recording() override;
  void destroy() override;

  const std::shared_ptr<simulation::Simulation>& simulation() const { return simulation_; }
  // Whether the simulation has received no call for too long. Always false for a simulation that
  // was created with keep.
  bool IsAbandoned() const;

 private:
  // Adds a robot or an avatar, and returns its name.
  std::string Add(const sba::RobotSpecification& robot, bool is_avatar);
  // Records that a client has called, so that the simulation does not count as abandoned.
  void NoteContact() { last_contact_ = std::chrono::steady_clock::now().time_since_epoch(); }

  const std::shared_ptr<simulation::Simulation> simulation_;
  SimulationServiceServant& service_;
  const sba::SimulationSpecification specification_;
  // time without a call after which the simulation is abandoned
  std::chrono::steady_clock::duration abandoned_after_;
  // time of the last call, since the clock's epoch
  std::atomic<std::chrono::steady_clock::duration> last_contact_;
};

// Creates simulations and lists them. Stops simulations that no client calls any more.
class SimulationServiceServant final : public POA_sba::SimulationService {
 public:
  // `host` and `behaviours` must outlive the object. If `behaviours` is null, clients must pass
  // references to behaviours.
  SimulationServiceServant(PortableServer::POA_ptr poa, SimulationHost& host,
                           BehaviourSource* behaviours, ServiceHooks hooks);
  ~SimulationServiceServant() override;

  sba::Simulation_ptr create_simulation(const sba::SimulationSpecification& specification) override;
  sba::Simulations* list() override;

  // Adds a simulation that was not created through this service. Does nothing if the simulation is
  // already in the list.
  void Publish(std::shared_ptr<simulation::Simulation> simulation);
  // Releases every simulation and deactivates its references.
  void Close();
  // Destroys a simulation. Returns kNotFound if there is none with this name.
  base::Status Destroy(const std::string& simulation);
  SimulationHost& host() { return host_; }
  BehaviourSource* behaviours() { return behaviours_; }
  const ServiceHooks& hooks() const { return hooks_; }
  PortableServer::POA_ptr poa() { return poa_; }

 private:
  // Makes the CORBA object of a simulation.
  sba::Simulation_ptr Activate(std::shared_ptr<simulation::Simulation> simulation,
                               sba::SimulationSpecification specification);
  // The function of the janitor thread, which stops abandoned simulations and returns memory to
  // the system.
  void RunJanitor();

  PortableServer::POA_var poa_;
  SimulationHost& host_;
  BehaviourSource* const behaviours_;
  const ServiceHooks hooks_;
  base::Mutex mutex_;
  base::ConditionVariable closing_changed_;      // notified when closing_ becomes true
  bool closing_ GSV_GUARDED_BY(mutex_) = false;  // whether the servant ends
  // whether a simulation was destroyed since the janitor's last check
  bool has_destroyed_ GSV_GUARDED_BY(mutex_) = false;
  std::map<std::string, SimulationServant*> servants_
      GSV_GUARDED_BY(mutex_);  // servants by simulation; the POA owns them
  std::jthread janitor_;       // executes RunJanitor()
};

}  // namespace gsv::services
