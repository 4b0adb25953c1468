#include "apps/gsv/simulations/simulation_builder.h"

#include <algorithm>
#include <utility>

#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/problem_report.h"
#include "apps/gsv/simulations/model_list.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "apps/gsv/simulations/world_saving.h"
#include "gsv/base/sorting.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/ros2/node_steps.h"

namespace gsv::app {
namespace {

using gateway::SimulationRequest;
using gateway::WrongField;
using simulation::Simulation;

namespace fs = std::filesystem;

constexpr std::size_t kWorldsKept = 4;
constexpr std::size_t kMaxOffers = 200;

// Adds the errors and then the warnings to `sentences`, without sentences that are there already.
void AddSentences(const base::Problems& problems, std::vector<std::string>& sentences) {
  for (const auto severity : {base::Problem::Severity::kError, base::Problem::Severity::kWarning}) {
    for (std::string& sentence : GroupedSentences(problems, severity)) {
      if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
        sentences.push_back(std::move(sentence));
    }
  }
}

simulation::Specification SpecificationOf(const scenario::Scenario& scenario) {
  simulation::Specification specification;
  specification.name = scenario.name;
  specification.mode =
      scenario.lockstep.value_or(false) ? simulation::Mode::kLockstep : simulation::Mode::kRealTime;
  specification.factor = scenario.factor.value_or(0);  // 0: the factor of the world file
  specification.step = base::FromSeconds(scenario.step.value_or(0));
  specification.duration = base::FromSeconds(scenario.duration.value_or(0));
  specification.seed = scenario.seed.value_or(0);
  specification.pedestrians = scenario.pedestrians;
  specification.keep = true;  // continues after the page that created the simulation is closed
  return specification;
}

// Whether this is the file of a built-in world.
bool IsWorldOfOurs(const fs::path& file) {
  std::error_code ignored;
  return fs::equivalent(file.parent_path(), ShareFolder() / "worlds", ignored);
}

}  // namespace

void SimulationBuilder::OfferThrough(services::SimulationServiceServant* service) {
  const base::MutexLock lock(mutex_);
  service_ = service;
}

void SimulationBuilder::PublishThrough(Ros2Publisher* publisher) {
  const base::MutexLock lock(mutex_);
  publisher_ = publisher;
}

Ros2Publisher* SimulationBuilder::publisher() {
  const base::MutexLock lock(mutex_);
  return publisher_;
}

std::vector<std::string> SimulationBuilder::Worlds() { return BuiltInWorlds(); }

std::vector<std::string> SimulationBuilder::Objects() {
  std::vector<std::string> objects = finder_.ModelNames();
  base::Sort(objects);
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
  const std::vector<std::string> robots = FindRobotModels(host_.library(), finder_.search_path());
  std::erase_if(objects, [&](const std::string& name) {
    return std::binary_search(robots.begin(), robots.end(), name);
  });
  return objects;
}

std::vector<SimulationBuilder::ModelLine> SimulationBuilder::Models() {
  std::vector<ModelLine> models;
  for (const std::string& name : FindRobotModels(host_.library(), finder_.search_path())) {
    models.push_back({name, name == "avatar"});
  }
  return models;
}

base::Result<SimulationBuilder::Behaviours> SimulationBuilder::FindBehaviours(
    const std::string& constraint) {
  const broker::ServiceType& type = broker::AgentBehaviourFactoryType();
  if (auto ok = broker_.EnsureServiceType(type); !ok) return base::Fail(ok.error());
  const auto offers = broker_.Query(type.name, constraint, "", kMaxOffers);
  if (!offers) return base::Fail(offers.error());
  Behaviours found;
  found.broker = broker_.reference();
  found.start_command = "gsv-wander --broker " + broker_.reference();
  for (const broker::FoundOffer& offer : *offers) {
    const broker::BehaviourOffer described = broker::BehaviourOfferFrom(offer.properties);
    found.offers.push_back({described.name, described.description, described.host, described.pid,
                            described.time_managed});
  }
  return found;
}

FieldResult<SimulationBuilder::KnownWorld> SimulationBuilder::ReadWorld(const std::string& world) {
  auto file = FindWorld(world);
  if (!file) return WrongField("world", file.error());
  KnownWorld read;
  read.file = *file;
  std::error_code ignored;
  read.changed = fs::last_write_time(read.file, ignored);
  {
    const base::MutexLock lock(mutex_);
    for (const KnownWorld& known : known_) {
      if (known.file == read.file && known.changed == read.changed) return known;
    }
  }
  if (!IsWorldOfOurs(read.file)) {
    if (auto ok = TryToRead(read.file, model_path_, reading_); !ok) {
      return WrongField("world", ok.error());
    }
  }
  base::Problems problems;
  auto description = host_.library().ReadWorld(read.file, problems);
  if (!description) return WrongField("world", description.error());
  read.world = std::make_shared<const model::WorldDescription>(*std::move(description));
  AddSentences(problems, read.warnings);
  const base::MutexLock lock(mutex_);
  known_.push_back(read);
  if (known_.size() > kWorldsKept) known_.erase(known_.begin());
  return read;
}

FieldResult<std::shared_ptr<simulation::BehaviourPort>> SimulationBuilder::BehaviourFor(
    const scenario::RobotEntry& robot) {
  const bool is_named = !robot.behaviour.empty();
  if (!is_named && robot.behaviour_constraint.empty()) return nullptr;
  auto behaviour = behaviours_.Get(is_named ? services::ConstraintForName(robot.behaviour)
                                            : robot.behaviour_constraint);
  if (!behaviour) {
    return WrongField(is_named ? "behaviour" : "behaviour_constraint", behaviour.error());
  }
  return *std::move(behaviour);
}

BehaviourMaker SimulationBuilder::BehaviourChoice(const ros2::Options* published) {
  return [this, published](const scenario::RobotEntry& robot)
             -> FieldResult<std::shared_ptr<simulation::BehaviourPort>> {
    if (robot.behaviour != ros2::kRos2Behaviour) return BehaviourFor(robot);
    if (published == nullptr) {
      return WrongField("behaviour",
                        {base::ErrorCode::kInvalidArgument,
                         "only robots of a simulation that is published to ROS 2 have this "
                         "behaviour",
                         "ros2"});
    }
    if (published->steps == nullptr) return nullptr;
    return std::make_shared<ros2::NodeBehaviour>(published->steps, ros2::kClockPeriod);
  };
}

SimulationBuilder::Ros2Support SimulationBuilder::Ros2() {
  Ros2Publisher* const there = publisher();
  return there == nullptr ? Ros2Support() : there->Support();
}

FieldResult<std::optional<ros2::Options>> SimulationBuilder::Ros2OptionsOf(
    const scenario::Scenario& scenario) {
  if (!scenario.ros2) return std::nullopt;
  Ros2Publisher* const there = publisher();
  if (there == nullptr) {
    return WrongField("ros2",
                      {base::ErrorCode::kUnavailable, "this server does not publish to ROS 2", {}});
  }
  auto options = there->OptionsOf(scenario);
  if (!options) return WrongField("ros2", options.error());
  return *std::move(options);
}

FieldResult<SimulationBuilder::Preview> SimulationBuilder::Show(const SimulationRequest& request) {
  if (const auto ros2 = Ros2OptionsOf(request.scenario); !ros2) {
    return base::Failure{ros2.error()};
  }
  auto world = ReadWorld(request.scenario.world);
  if (!world) return base::Failure{world.error()};
  simulation::Specification specification = SpecificationOf(request.scenario);
  specification.name = "preview";
  // one thread suffices, because the simulation takes no steps
  specification.mode = simulation::Mode::kRealTime;
  auto driven = WithDrives(world->world, request.scenario);
  if (!driven) return WrongField("robots", driven.error());
  specification.world = *std::move(driven);
  auto simulation = host_.CreateUnlisted(std::move(specification));
  if (!simulation) return WrongField("", simulation.error());
  Preview preview{*simulation, world->warnings};
  base::Problems problems;
  const auto population = Populate(**simulation, host_.library(), request.scenario, problems);
  if (!population) return base::Failure{population.error()};
  AddSentences(problems, preview.warnings);
  return preview;
}

FieldResult<std::shared_ptr<Simulation>> SimulationBuilder::Create(
    const SimulationRequest& request) {
  const auto ros2 = Ros2OptionsOf(request.scenario);
  if (!ros2) return base::Failure{ros2.error()};
  auto world = ReadWorld(request.scenario.world);
  if (!world) return base::Failure{world.error()};
  simulation::Specification specification = SpecificationOf(request.scenario);
  auto driven = WithDrives(world->world, request.scenario);
  if (!driven) return WrongField("robots", driven.error());
  specification.world = *std::move(driven);
  base::Problems problems;  // the world's problems were already reported with its preview
  auto created = host_.Create(std::move(specification), {}, problems);
  if (!created) return WrongField("name", created.error());
  const std::string name = (*created)->specification().name;
  const auto give_up = [&](FieldError wrong) {
    (void)host_.Remove(name);
    return base::Failure{std::move(wrong)};
  };
  const auto population = Populate(**created, host_.library(), request.scenario, problems);
  if (!population) return give_up(population.error());
  const ros2::Options* const published = *ros2 ? &**ros2 : nullptr;
  const auto given = GiveBehaviours(**created, population->robots, BehaviourChoice(published));
  if (!given) return give_up(given.error());
  if (published != nullptr) {
    if (auto ok = publisher()->Publish(*created, *published); !ok) {
      return give_up({ok.error(), "ros2"});
    }
    recordings_.SetRos2(*created, *request.scenario.ros2);
  }
  if (request.record) {
    if (auto ok = recordings_.Record(*created); !ok) return give_up({ok.error(), "record"});
  }
  const base::MutexLock lock(mutex_);
  if (service_ != nullptr) service_->Publish(*created);
  return *created;
}

base::Status SimulationBuilder::Destroy(const std::string& simulation) {
  // this fails for most simulations, because they are not recorded
  (void)recordings_.Stop(simulation);
  const base::MutexLock lock(mutex_);
  if (service_ != nullptr && service_->Destroy(simulation)) return {};
  if (const auto found = host_.Find(simulation)) (void)found->Stop();
  return host_.Remove(simulation);
}

FieldResult<std::string> SimulationBuilder::AddRobot(const std::shared_ptr<Simulation>& simulation,
                                                     const scenario::RobotEntry& robot,
                                                     bool is_avatar) {
  base::Problems problems;
  const bool is_published = Ros2().published == simulation->specification().name;
  // `steps` stays null, because a robot that is added later does not wait for the commands of a ROS
  // 2 node. Only the robots of the scenario do.
  const ros2::Options options;
  return AddOne(*simulation, host_.library(), robot, is_avatar,
                BehaviourChoice(is_published ? &options : nullptr), problems);
}

FieldResult<std::string> SimulationBuilder::AddObject(const std::shared_ptr<Simulation>& simulation,
                                                      const gateway::ObjectRequest& object) {
  base::Problems problems;
  return AddOneObject(*simulation, host_.library(), object, problems);
}

base::Result<gateway::SimulationFactory::SavedWorld> SimulationBuilder::SaveWorld(
    const simulation::Simulation& simulation, const std::string& file) {
  formats::ReadOptions options;
  options.model_path = model_path_;
  return app::SaveWorld(simulation, file, options);
}

}  // namespace gsv::app
