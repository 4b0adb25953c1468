#include "apps/gsv/simulation_builder.h"

#include <algorithm>
#include <utility>

#include "apps/gsv/installation.h"
#include "apps/gsv/model_list.h"
#include "apps/gsv/population.h"
#include "gsv/broker/client/gsv_service_types.h"

namespace gsv::app {
namespace {

using gateway::FieldError;
using gateway::FieldResult;
using gateway::RobotRequest;
using gateway::SimulationRequest;
using simulation::RobotSpecification;
using simulation::Simulation;

namespace fs = std::filesystem;

constexpr std::size_t kWorldsKept = 4;
constexpr std::size_t kMostOffers = 200;

tl::unexpected<FieldError> Wrong(std::string field, base::Error error) {
  return tl::make_unexpected(FieldError{std::move(error), std::move(field)});
}

// Names the list's element before the field that is wrong with it.
tl::unexpected<FieldError> WrongIn(const char* list, std::size_t i, FieldError wrong) {
  std::string element = std::string(list) + "[" + std::to_string(i) + "]";
  wrong.field = wrong.field.empty() ? element : element + "." + wrong.field;
  return tl::make_unexpected(std::move(wrong));
}

// Each once, in order.
void AddSentences(const base::Problems& problems, std::vector<std::string>& sentences) {
  for (const base::Problem& problem : problems) {
    std::string sentence = problem.Sentence();
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
      sentences.push_back(std::move(sentence));
  }
}

simulation::Specification SpecificationOf(const SimulationRequest& request) {
  simulation::Specification specification;
  specification.name = request.name;
  specification.mode = request.mode;
  specification.factor = request.factor;
  specification.step = base::FromSeconds(request.step);
  specification.duration = base::FromSeconds(request.duration);
  specification.seed = request.seed;
  specification.keep = true;  // the page that created it may be closed
  return specification;
}

}  // namespace

void SimulationBuilder::OfferThrough(services::SimulationServiceServant* service) {
  const std::lock_guard lock(mutex_);
  service_ = service;
}

std::vector<std::string> SimulationBuilder::Worlds() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(ShareFolder() / "worlds", ignored)) {
    if (entry.path().extension() == ".sdf") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<SimulationBuilder::ModelLine> SimulationBuilder::Models() {
  std::vector<fs::path> folders{ShareFolder() / "models"};
  folders.insert(folders.end(), model_path_.begin(), model_path_.end());
  std::vector<ModelLine> models;
  for (const std::string& name : FindRobotModels(host_.library(), folders)) {
    models.push_back({name, name == "avatar"});
  }
  return models;
}

base::Result<SimulationBuilder::Behaviours> SimulationBuilder::FindBehaviours(
    const std::string& constraint) {
  const broker::ServiceType& type = broker::AgentBehaviourFactoryType();
  if (auto ok = broker_.EnsureServiceType(type); !ok) return base::Fail(ok.error());
  const auto offers = broker_.Query(type.name, constraint, "", kMostOffers);
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
  KnownWorld read;
  read.file = ResolveWorld(world);
  std::error_code ignored;
  read.changed = fs::last_write_time(read.file, ignored);
  {
    const std::lock_guard lock(mutex_);
    for (const KnownWorld& known : known_) {
      if (known.file == read.file && known.changed == read.changed) return known;
    }
  }
  base::Problems problems;
  auto description = host_.library().ReadWorld(read.file, problems);
  if (!description) return Wrong("world", description.error());
  read.world = std::make_shared<const model::WorldDescription>(*std::move(description));
  AddSentences(problems, read.warnings);
  const std::lock_guard lock(mutex_);
  known_.push_back(read);
  if (known_.size() > kWorldsKept) known_.erase(known_.begin());
  return read;
}

FieldResult<RobotSpecification> SimulationBuilder::Specify(const Simulation& simulation,
                                                           const RobotRequest& request,
                                                           bool is_avatar,
                                                           std::vector<std::string>& warnings) {
  base::Problems problems;
  auto model =
      host_.library().ReadModel(request.model, problems, simulation.specification().world->source);
  AddSentences(problems, warnings);
  if (!model) return Wrong("model", model.error());
  if (!(*model)->drive) {
    return Wrong("model", {base::ErrorCode::kBadModel,
                           "it has no drive that gsv knows, so it cannot be a robot; choose "
                           "another",
                           request.model});
  }
  RobotSpecification robot;
  robot.name = request.name;
  robot.model = *model;
  robot.is_avatar = is_avatar;
  robot.movement = request.movement;
  if (const auto& place = request.place) {
    robot.world_from_robot =
        geometry::PlanarPose(place->x, place->y, place->z.value_or(0), place->yaw);
    robot.on_ground = !place->z.has_value();
  }
  return robot;
}

FieldResult<std::vector<std::string>> SimulationBuilder::Place(
    Simulation& simulation, const std::vector<RobotRequest>& robots, bool are_avatars,
    std::vector<std::string>& warnings) {
  const char* const list = are_avatars ? "avatars" : "robots";
  std::vector<std::string> names(robots.size());
  std::vector<RobotSpecification> placed;
  std::vector<std::size_t> index;  // of those, in `robots`
  std::vector<std::pair<std::size_t, RobotSpecification>> free;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    auto robot = Specify(simulation, robots[i], are_avatars, warnings);
    if (!robot) return WrongIn(list, i, robot.error());
    if (!robots[i].place) {
      free.emplace_back(i, *std::move(robot));
      continue;
    }
    placed.push_back(*std::move(robot));
    index.push_back(i);
  }
  if (const auto added = simulation.AddRobots(std::move(placed))) {
    for (std::size_t k = 0; k < index.size(); ++k) names[index[k]] = (*added)[k];
  } else {
    // Which one it was is known by its name; one that was to be named after its model has none yet.
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (robots[i].place && robots[i].name == added.error().where)
        return WrongIn(list, i, {added.error(), ""});
    }
    return Wrong(list, added.error());
  }
  for (auto& [i, robot] : free) {
    auto placed = AddAtFreePlace(simulation, std::move(robot));
    if (!placed) return WrongIn(list, i, {placed.error(), ""});
    names[i] = std::move(placed->name);
  }
  return names;
}

FieldResult<std::vector<std::string>> SimulationBuilder::Populate(
    Simulation& simulation, const SimulationRequest& request, std::vector<std::string>& warnings) {
  auto names = Place(simulation, request.robots, false, warnings);
  if (!names) return names;
  if (auto avatars = Place(simulation, request.avatars, true, warnings); !avatars) return avatars;
  return names;
}

FieldResult<std::shared_ptr<simulation::BehaviourPort>> SimulationBuilder::BehaviourFor(
    const RobotRequest& robot) {
  const bool is_named = !robot.behaviour.empty();
  if (!is_named && robot.behaviour_constraint.empty()) return nullptr;
  auto behaviour = behaviours_.Get(is_named ? services::ConstraintForName(robot.behaviour)
                                            : robot.behaviour_constraint);
  if (!behaviour) {
    return Wrong(is_named ? "behaviour" : "behaviour_constraint", behaviour.error());
  }
  return *std::move(behaviour);
}

tl::expected<void, FieldError> SimulationBuilder::GiveBehaviours(
    Simulation& simulation, const std::vector<RobotRequest>& robots,
    const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    auto behaviour = BehaviourFor(robots[i]);
    if (!behaviour) return WrongIn("robots", i, behaviour.error());
    if (*behaviour == nullptr) continue;
    if (auto ok = simulation.SetBehaviour(names[i], *behaviour); !ok) {
      (*behaviour)->Destroy();
      return WrongIn("robots", i, {ok.error(), "behaviour"});
    }
  }
  return {};
}

FieldResult<SimulationBuilder::Preview> SimulationBuilder::Show(const SimulationRequest& request) {
  auto world = ReadWorld(request.world);
  if (!world) return tl::make_unexpected(world.error());
  simulation::Specification specification = SpecificationOf(request);
  specification.name = "preview";
  specification.mode = simulation::Mode::kRealTime;  // on one thread: it takes no step
  specification.world = world->world;
  auto simulation = host_.CreateUnlisted(std::move(specification));
  if (!simulation) return Wrong("", simulation.error());
  Preview preview{*simulation, world->warnings};
  if (auto names = Populate(**simulation, request, preview.warnings); !names) {
    return tl::make_unexpected(names.error());
  }
  return preview;
}

FieldResult<std::shared_ptr<Simulation>> SimulationBuilder::Create(
    const SimulationRequest& request) {
  auto world = ReadWorld(request.world);
  if (!world) return tl::make_unexpected(world.error());
  simulation::Specification specification = SpecificationOf(request);
  specification.world = world->world;
  base::Problems none;  // of a world that is read already
  auto created = host_.Create(std::move(specification), {}, none);
  if (!created) return Wrong("name", created.error());
  const std::string name = (*created)->specification().name;
  const auto give_up = [&](FieldError wrong) {
    (void)host_.Remove(name);
    return tl::make_unexpected(std::move(wrong));
  };
  auto names = Populate(**created, request, world->warnings);
  if (!names) return give_up(names.error());
  if (auto ok = GiveBehaviours(**created, request.robots, *names); !ok) return give_up(ok.error());
  if (request.record) {
    if (auto ok = recordings_.Record(*created); !ok) return give_up({ok.error(), "record"});
  }
  const std::lock_guard lock(mutex_);
  if (service_ != nullptr) service_->Publish(*created);
  return *created;
}

base::Status SimulationBuilder::Destroy(const std::string& simulation) {
  (void)recordings_.Stop(simulation);  // most are not recorded
  const std::lock_guard lock(mutex_);
  if (service_ != nullptr && service_->Destroy(simulation)) return {};
  if (const auto found = host_.Find(simulation)) (void)found->Stop();
  return host_.Remove(simulation);
}

FieldResult<std::string> SimulationBuilder::AddRobot(const std::shared_ptr<Simulation>& simulation,
                                                     const RobotRequest& request, bool is_avatar) {
  std::vector<std::string> warnings;
  auto robot = Specify(*simulation, request, is_avatar, warnings);
  if (!robot) return tl::make_unexpected(robot.error());
  auto behaviour = BehaviourFor(request);
  if (!behaviour) return tl::make_unexpected(behaviour.error());
  robot->behaviour = *behaviour;
  auto name = request.place ? simulation->AddRobot(*robot)
                            : AddAtFreePlace(*simulation, *robot).map(&PlacedRobot::name);
  if (name) return *std::move(name);
  if (*behaviour != nullptr) (*behaviour)->Destroy();
  const bool is_behaviours = name.error().code == base::ErrorCode::kBehaviour;
  return Wrong(is_behaviours ? "behaviour" : "", name.error());
}

}  // namespace gsv::app
