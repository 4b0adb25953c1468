#include "apps/gsv/simulations/population.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gsv/base/random.h"

namespace gsv::app {
namespace {

using gateway::WrongField;
using simulation::RobotSpecification;
using simulation::Simulation;

constexpr int kPlacesTried = 400;

// Adds the list and the index to the path of the invalid field, as in "robots[1].model".
base::Failure<FieldError> WrongIn(const char* list, std::size_t i, FieldError wrong) {
  std::string element = std::string(list) + "[" + std::to_string(i) + "]";
  wrong.field = wrong.field.empty() ? element : element + "." + wrong.field;
  return base::Failure{std::move(wrong)};
}

// Returns the n-th place of a spiral about the origin. Adjacent places are about a metre apart.
scenario::Place SpiralPlace(int n) {
  const double turns = std::sqrt(static_cast<double>(n));
  const double angle = turns * std::numbers::pi * 2 / 1.8;
  return {0.7 * turns * std::cos(angle), 0.7 * turns * std::sin(angle), {}, angle};
}

// Returns the nth cell of a grid of 1 m. Cells are counted ring by ring from the origin.
scenario::Place GridPlace(int n) {
  if (n == 0) return {0, 0, {}, 0};
  const int ring = static_cast<int>(std::ceil((std::sqrt(n + 1.0) - 1) / 2));
  const int side = 2 * ring;
  const int at = n - (side - 1) * (side - 1);  // index in the ring, counted from its first corner
  const int along = at % side - ring;
  switch (at / side) {
    case 0:
      return {static_cast<double>(ring), static_cast<double>(along), {}, 0};
    case 1:
      return {static_cast<double>(-along), static_cast<double>(ring), {}, 0};
    case 2:
      return {static_cast<double>(-ring), static_cast<double>(-along), {}, 0};
    default:
      return {static_cast<double>(along), static_cast<double>(-ring), {}, 0};
  }
}

// Returns a place in a disc that has about 5 m² for each robot.
scenario::Place RandomPlace(int n, const Placing& placing) {
  base::Noise noise(placing.seed, base::StableId("places"), n);
  const double radius = std::sqrt(5.0 * std::max(placing.count, 1) / std::numbers::pi);
  const double distance = radius * std::sqrt(noise.Uniform());
  const double angle = 2 * std::numbers::pi * noise.Uniform();
  const double yaw = std::numbers::pi * (2 * noise.Uniform() - 1);
  return {distance * std::cos(angle), distance * std::sin(angle), {}, yaw};
}

scenario::Place PlaceNumber(int n, const Placing& placing) {
  if (placing.kind == Placing::Kind::kGrid) return GridPlace(n);
  return placing.kind == Placing::Kind::kRandom ? RandomPlace(n, placing) : SpiralPlace(n);
}

void Stand(const scenario::Place& place, RobotSpecification& robot) {
  robot.world_from_robot = place.pose();
  robot.on_ground = !place.z;
}

base::Result<std::shared_ptr<const model::Model>> ModelFor(const Simulation& simulation,
                                                           formats::ModelLibrary& library,
                                                           const scenario::RobotEntry& entry,
                                                           base::Problems& problems) {
  if (!entry.model.empty()) {
    return library.ReadModel(entry.model, problems, simulation.specification().world->source);
  }
  if (auto model = ModelInWorld(simulation, entry.name)) return model;
  return base::Fail(base::ErrorCode::kNotFound, "the world has no robot of this name", entry.name);
}

FieldResult<RobotSpecification> Specify(const Simulation& simulation,
                                        formats::ModelLibrary& library,
                                        const scenario::RobotEntry& entry, bool is_avatar,
                                        base::Problems& problems) {
  const auto model = ModelFor(simulation, library, entry, problems);
  if (!model) return WrongField(entry.model.empty() ? "name" : "model", model.error());
  RobotSpecification robot;
  robot.name = entry.name;
  robot.model = *model;
  robot.is_avatar = is_avatar;
  robot.movement = entry.movement;
  robot.drive = entry.drive;
  if (entry.start) Stand(*entry.start, robot);
  return robot;
}

// Adds the robot at the first free place, from place number `next` on. Sets the entry's name and
// place to the actual name and place. Sets `next` to the number of the following place.
base::Status AddAtFreePlace(Simulation& simulation, RobotSpecification robot,
                            scenario::RobotEntry& entry, const Placing& placing, int& next) {
  base::Error refusal;
  const int end = next + kPlacesTried;
  while (next < end) {
    const scenario::Place place = PlaceNumber(next++, placing);
    Stand(place, robot);
    auto name = simulation.AddRobot(robot);
    if (name) {
      entry.name = *std::move(name);
      entry.start = place;
      return {};
    }
    refusal = name.error();
  }
  return base::Fail(refusal);
}

// First adds all robots with a given place in one call, because adding a crowd robot by robot is
// slow. Then adds the robots without a place.
class ListPlacing {
 public:
  ListPlacing(Simulation& simulation, formats::ModelLibrary& library, const char* list,
              base::Problems& problems, const Placing& placing)
      : simulation_(simulation),
        library_(library),
        list_(list),
        is_avatars_(list == std::string_view("avatars")),
        problems_(problems),
        placing_(placing) {}

  FieldResult<std::vector<PlacedRobot>> Place(const std::vector<scenario::RobotEntry>& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].model.empty()) {
        if (auto ok = FindInWorld(entries[i], i); !ok) return base::Failure{ok.error()};
        continue;
      }
      auto robot = Specify(simulation_, library_, entries[i], is_avatars_, problems_);
      if (!robot) return WrongIn(list_, i, robot.error());
      (entries[i].start ? with_place_ : without_).push_back({{entries[i], i}, *std::move(robot)});
    }
    if (auto ok = PlaceTogether(); !ok) return base::Failure{ok.error()};
    int next = 0;
    for (Waiting& each : without_) {
      if (placing_.kind == Placing::Kind::kSpiral) next = 0;
      if (auto ok =
              AddAtFreePlace(simulation_, std::move(each.robot), each.placed.entry, placing_, next);
          !ok)
        return WrongIn(list_, each.placed.index, {ok.error(), ""});
      placed_.push_back(std::move(each.placed));
    }
    std::move(of_world_.begin(), of_world_.end(), std::back_inserter(placed_));
    return std::move(placed_);
  }

 private:
  struct Waiting {
    PlacedRobot placed;
    RobotSpecification robot;
  };

  FieldResult<void> FindInWorld(const scenario::RobotEntry& entry, std::size_t i) {
    if (simulation_.agent(entry.name) != nullptr) {
      of_world_.push_back({entry, i});
      return {};
    }
    return WrongIn(list_, i,
                   {{base::ErrorCode::kInvalidArgument,
                     "the world has no robot of this name; a new robot needs a model", entry.name},
                    "name"});
  }

  FieldResult<void> PlaceTogether() {
    std::vector<RobotSpecification> robots;
    for (Waiting& each : with_place_) robots.push_back(std::move(each.robot));
    auto names = simulation_.AddRobots(std::move(robots));
    if (!names) return base::Failure{BlameFor(names.error())};
    for (std::size_t k = 0; k < with_place_.size(); ++k) {
      with_place_[k].placed.entry.name = std::move((*names)[k]);
      placed_.push_back(std::move(with_place_[k].placed));
    }
    return {};
  }

  // Returns the error with the entry of the robot that `error.where` names. If an entry has no name
  // (its robot would get the name of the model), returns the error with the name of the list.
  FieldError BlameFor(const base::Error& error) const {
    for (const Waiting& each : with_place_) {
      if (each.placed.entry.name != error.where) continue;
      return WrongIn(list_, each.placed.index, {error, ""}).error;
    }
    return {error, list_};
  }

  Simulation& simulation_;
  formats::ModelLibrary& library_;
  const char* const list_;
  const bool is_avatars_;
  base::Problems& problems_;
  const Placing placing_;
  std::vector<Waiting> with_place_, without_;
  std::vector<PlacedRobot> of_world_, placed_;
};

}  // namespace

std::shared_ptr<const model::Model> ModelInWorld(const Simulation& simulation,
                                                 const std::string& name) {
  for (const model::PlacedModel& placed : simulation.specification().world->models) {
    if (placed.name == name) return placed.model;
  }
  return nullptr;
}

FieldResult<Population> Populate(Simulation& simulation, formats::ModelLibrary& library,
                                 const scenario::Scenario& scenario, base::Problems& problems,
                                 const Placing& placing) {
  auto robots =
      ListPlacing(simulation, library, "robots", problems, placing).Place(scenario.robots);
  if (!robots) return base::Failure{robots.error()};
  auto avatars = ListPlacing(simulation, library, "avatars", problems, {}).Place(scenario.avatars);
  if (!avatars) return base::Failure{avatars.error()};
  return Population{*std::move(robots), *std::move(avatars)};
}

FieldResult<void> GiveBehaviours(Simulation& simulation, const std::vector<PlacedRobot>& robots,
                                 const BehaviourMaker& make) {
  for (const PlacedRobot& robot : robots) {
    auto behaviour = make(robot.entry);
    if (!behaviour) return WrongIn("robots", robot.index, behaviour.error());
    if (*behaviour == nullptr) continue;
    if (auto ok = simulation.SetBehaviour(robot.entry.name, *behaviour); !ok) {
      (*behaviour)->Destroy();
      return WrongIn("robots", robot.index, {ok.error(), "behaviour"});
    }
  }
  return {};
}

FieldResult<std::string> AddOne(Simulation& simulation, formats::ModelLibrary& library,
                                const scenario::RobotEntry& entry, bool is_avatar,
                                const BehaviourMaker& make, base::Problems& problems) {
  auto robot = Specify(simulation, library, entry, is_avatar, problems);
  if (!robot) return base::Failure{robot.error()};
  auto behaviour = make(entry);
  if (!behaviour) return base::Failure{behaviour.error()};
  robot->behaviour = *behaviour;
  scenario::RobotEntry placed = entry;
  base::Status added;
  if (!entry.start) {
    int next = 0;
    added = AddAtFreePlace(simulation, *robot, placed, {}, next);
  } else if (auto name = simulation.AddRobot(*robot)) {
    placed.name = *std::move(name);
  } else {
    added = base::Fail(name.error());
  }
  if (added) return placed.name;
  if (*behaviour != nullptr) (*behaviour)->Destroy();
  const bool is_behaviours = added.error().code == base::ErrorCode::kBehaviour;
  return WrongField(is_behaviours ? "behaviour" : "", added.error());
}

FieldResult<std::string> AddOneObject(Simulation& simulation, formats::ModelLibrary& library,
                                      const gateway::ObjectRequest& request,
                                      base::Problems& problems) {
  simulation::ObjectSpecification object;
  object.name = request.name;
  object.copy_of = request.copy_of;
  if (!request.model.empty()) {
    auto model =
        library.ReadModel(request.model, problems, simulation.specification().world->source);
    if (!model) return WrongField("model", model.error());
    object.model = *std::move(model);
  }
  if (request.place) {
    object.world_from_object = request.place->world_from_body;
    object.on_ground = request.place->on_ground;
    auto name = simulation.AddObject(std::move(object));
    return name ? FieldResult<std::string>(*std::move(name)) : WrongField("", name.error());
  }
  base::Error refusal;
  for (int n = 0; n < kPlacesTried; ++n) {
    object.world_from_object = SpiralPlace(n).pose();
    auto name = simulation.AddObject(object);
    if (name) return *std::move(name);
    refusal = name.error();
    // Only kBadModel means that the place is taken. Any other error would occur at each place: a
    // wrong name, a wrong model, or a simulation that is not paused.
    if (refusal.code != base::ErrorCode::kBadModel) break;
  }
  return WrongField("", refusal);
}

}  // namespace gsv::app
