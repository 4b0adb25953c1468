#include "gsv/formats/sdf/world_reader.h"

#include <algorithm>
#include <cctype>
#include <deque>
#include <set>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/Light.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

#include "gsv/base/sorting.h"
#include "gsv/formats/sdf/builtin_models.h"
#include "gsv/formats/sdf/include_scan.h"
#include "gsv/formats/sdf/joint_mimic.h"
#include "gsv/formats/sdf/ros2_control.h"
#include "gsv/formats/sdf/sdf_actor.h"
#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_medium.h"
#include "gsv/formats/sdf/sdf_pedestrians.h"
#include "gsv/formats/sdf/sdf_world.h"
#include "gsv/formats/sdf/value_repair.h"
#include "gsv/formats/sdf/value_text.h"
#include "gsv/formats/sdf/world_frames.h"
#include "gsv/formats/sdf/world_state.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using base::Problem;
using geometry::Pose;
using model::WorldDescription;
using tinyxml2::XMLElement;

constexpr std::size_t kModelsPerDocument = 48;

class WorldReader {
 public:
  WorldReader(XmlFile& file, ModelStore& store, base::Problems& problems)
      : file_(file),
        store_(store),
        problems_(problems),
        context_(store.ContextFor(file.path, problems)),
        scan_(store.finder(), store.limits(), problems) {}

  base::Result<WorldDescription> Read() {
    XMLElement* world = file_.root->FirstChildElement("world");
    if (world == nullptr) {
      return Fail(ErrorCode::kBadModel, "the file contains no <world>", file_.path.string());
    }
    const char* name = world->Attribute("name");
    world_.name = name == nullptr ? "world" : name;
    world_.source = file_.path.string();
    if (const XMLElement* second = world->NextSiblingElement("world")) {
      context_.Warn("only the first world of a file is read", PlaceOf(file_.path, *second));
    }
    state_.Read(*world, context_);
    RepairValues(*world, file_.path, problems_);
    ReadMedium(*world, context_, world_);
    TakeScripts(*world);
    if (auto status = TakeIncludes(*world); !status) return Fail(status.error());
    scan_.Scan(*world, file_.path);
    if (auto status = TakeParts(*world); !status) return Fail(status.error());
    ParseDocuments();
    PlaceModels();
    PlaceLights();
    return std::move(world_);
  }

 private:
  // One model of the world, inline or included.
  struct Placement {
    std::string name, place;
    WrittenPose at;
    std::string placement_frame;
    std::optional<bool> is_static;
    bool uses_own_pose = false;                // whether the <include> has no <pose>
    std::size_t distinct = 0;                  // index of an inline model in distinct_
    std::shared_ptr<const StoredFile> stored;  // set for an included model
  };

  // A group of inline models that differ only in name and pose.
  struct Distinct {
    XMLElement* element;
    std::optional<FramedModel> framed;
  };

  struct PlacedLight {
    std::string place;
    WrittenPose at;
    model::Light light;
  };

  std::string Place(const XMLElement& element) const { return PlaceOf(file_.path, element); }

  // Returns the name without "::" and control characters, because names are parts of scoped names
  // ("a::b") and of lines of text.
  std::string AllowedName(const std::string& wanted, const std::string& place) {
    if (wanted.empty()) return "unnamed";
    std::string name = wanted;
    for (std::size_t at = 0; (at = name.find("::", at)) != std::string::npos;) {
      name.replace(at, 2, ".");
    }
    for (char& c : name) {
      if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
    }
    if (name != wanted) {
      context_.Warn("a name cannot contain \"::\" or control characters: " + Quoted(wanted) +
                        " is read as " + Quoted(name),
                    place);
    }
    return name;
  }

  std::string UniqueName(const std::string& wanted, const std::string& place) {
    const std::string name = AllowedName(wanted, place);
    std::string unique = name;
    for (int i = 1; !names_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    if (unique != name) {
      context_.Warn("there is a second \"" + name + "\"; it is named " + unique, place);
    }
    return unique;
  }

  WrittenPose PoseOf(const XMLElement& element) {
    auto pose = ReadPose(element);
    if (pose) return *pose;
    context_.Warn(pose.error().message, Place(element));
    return {};
  }

  // Converts actors to models with a script.
  void TakeScripts(XMLElement& world) {
    for (auto* child = world.FirstChildElement("actor"); child != nullptr;) {
      auto* const next = child->NextSiblingElement("actor");
      scripts_[child] = MakeModelOfActor(*child, context_);
      child = next;
    }
  }

  // Reads the included files from the store. Replaces includes of built-in models by the text of
  // the model.
  base::Status TakeIncludes(XMLElement& world) {
    XMLElement* next = nullptr;
    for (auto* child = world.FirstChildElement("include"); child != nullptr; child = next) {
      next = child->NextSiblingElement("include");
      const std::string uri = UriOf(*child);
      auto found = scan_.FileOf(uri, file_.path);
      if (found) {
        if (auto status = Include(*child, *found); !status) return status;
      } else if (const std::string_view text = BuiltInModel(uri); !text.empty()) {
        InsertBuiltIn(*child, text);
      } else {
        context_.Warn(IncludeLeftOut(uri, found.error()), Place(*child));
      }
      world.DeleteChild(child);
    }
    return {};
  }

  base::Status Include(const XMLElement& include, const std::filesystem::path& found) {
    std::string plugins;
    for (auto* plugin = include.FirstChildElement("plugin"); plugin != nullptr;
         plugin = plugin->NextSiblingElement("plugin")) {
      plugins += PrintCompact(*plugin);
    }
    auto stored = store_.Read(found, plugins);
    if (!stored) {
      base::Problems reasons = store_.TakeProblemsOfRefused();
      if (refused_.insert(found).second) {
        problems_.insert(problems_.end(), reasons.begin(), reasons.end());
      }
      context_.Warn(IncludeLeftOut(UriOf(include), stored.error()), Place(include));
      return {};
    }
    if (reported_.insert(stored->get()).second) {
      problems_.insert(problems_.end(), (*stored)->problems.begin(), (*stored)->problems.end());
    }
    Placement placement;
    placement.place = Place(include);
    placement.stored = *stored;
    placement.at = PoseOf(include);
    placement.uses_own_pose = include.FirstChildElement("pose") == nullptr;
    if (const auto* text = include.FirstChildElement("placement_frame")) {
      placement.placement_frame = text->GetText() == nullptr ? "" : text->GetText();
    }
    if (const auto* text = include.FirstChildElement("static")) {
      placement.is_static = text->BoolText(false);
    }
    const auto* name = include.FirstChildElement("name");
    placement.name = name != nullptr && name->GetText() != nullptr ? name->GetText() : "";
    if ((*stored)->light) {
      AddIncludedLight(placement);
      return {};
    }
    if (placement.name.empty()) placement.name = (*stored)->framed.model->name;
    placement.name = UniqueName(placement.name, placement.place);
    return Add(std::move(placement));
  }

  void AddIncludedLight(const Placement& placement) {
    PlacedLight placed{placement.place, placement.at, *placement.stored->light};
    if (placement.uses_own_pose) placed.at.pose = placement.stored->world_from_light;
    if (!placement.name.empty()) placed.light.name = placement.name;
    lights_.push_back(std::move(placed));
  }

  base::Status Add(Placement placement) {
    if (placements_.size() >= store_.limits().models_in_world) {
      return Fail(ErrorCode::kBadModel,
                  "the world has more than the limit of " +
                      std::to_string(store_.limits().models_in_world) + " models",
                  file_.path.string());
    }
    placements_.push_back(std::move(placement));
    return {};
  }

  base::Status TakeParts(XMLElement& world) {
    for (auto* child = world.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind == "model") {
        if (auto status = TakeModel(*child); !status) return status;
      } else if (kind == "light") {
        TakeLight(*child);
      } else if (kind == "gsv:pedestrians") {
        if (auto group = ReadPedestrians(*child, context_)) world_.pedestrians.push_back(group);
      } else if (kind == "frame") {
        TakeFrame(*child);
      } else if (kind == "physics" || kind == "gravity" || kind == "scene" ||
                 kind == "magnetic_field" || kind == "spherical_coordinates" ||
                 kind == "atmosphere") {
        surroundings_.push_back(child);
      }
    }
    return {};
  }

  base::Status TakeModel(XMLElement& element) {
    Placement placement;
    placement.place = Place(element);
    placement.at = PoseOf(element);
    const char* name = element.Attribute("name");
    placement.name = UniqueName(name == nullptr ? "" : name, placement.place);
    const char* frame = element.Attribute("placement_frame");
    placement.placement_frame = frame == nullptr ? "" : frame;
    if (auto* pose = element.FirstChildElement("pose")) element.DeleteChild(pose);
    element.DeleteAttribute("placement_frame");

    element.SetAttribute("name", "");
    const auto script = scripts_.find(&element);
    // The key of an actor includes its name. So two actors never share a model, because each has
    // its own script.
    const std::string own = script == scripts_.end() ? "" : placement.name;
    const auto [it, is_new] =
        distinct_by_text_.emplace(PrintCompact(element) + own, distinct_.size());
    element.SetAttribute("name", placement.name.c_str());
    if (is_new) distinct_.push_back({&element, std::nullopt});
    placement.distinct = it->second;
    return Add(std::move(placement));
  }

  void TakeLight(XMLElement& element) {
    PlacedLight placed{Place(element), PoseOf(element), {}};
    const char* name = element.Attribute("name");
    placed.light.name = UniqueName(name == nullptr ? "" : name, placed.place);
    element.SetAttribute("name", placed.light.name.c_str());
    if (auto* pose = element.FirstChildElement("pose")) element.DeleteChild(pose);
    surroundings_.push_back(&element);
    lights_.push_back(std::move(placed));
  }

  void TakeFrame(const XMLElement& element) {
    const auto at = ReadFramePose(element);
    if (!at) context_.Warn(at.error().message, Place(element));
    if (const char* name = element.Attribute("name")) frames_.Add(name, at.value_or(WrittenPose{}));
  }

  void ParseDocuments() {
    for (std::size_t first = 0; first == 0 || first < distinct_.size();
         first += kModelsPerDocument) {
      ParseModels(first, std::min(distinct_.size(), first + kModelsPerDocument));
    }
  }

  // Parses the models from `first` to `end` of distinct_ in one document. If this fails, parses
  // each model separately, so that an error in one model does not affect the others.
  void ParseModels(std::size_t first, std::size_t end) {
    base::Problems problems;
    const auto document =
        ParseSdf({file_.path, Document(first, end, first == 0)}, scan_.files(), problems);
    const bool is_sound = document && !document->has_broken_frames;
    if (is_sound || end - first <= 1) {
      Take(document, first, end, first == 0, problems);
      return;
    }
    for (std::size_t i = first; i < end; ++i) {
      problems.clear();
      const bool has_surroundings = i == 0;
      Take(ParseSdf({file_.path, Document(i, i + 1, has_surroundings)}, scan_.files(), problems), i,
           i + 1, has_surroundings, problems);
    }
  }

  void Take(const base::Result<SdfDocument>& document, std::size_t first, std::size_t end,
            bool has_surroundings, const base::Problems& problems) {
    problems_.insert(problems_.end(), problems.begin(), problems.end());
    const sdf::World* world = document ? document->root->WorldByIndex(0) : nullptr;
    if (world == nullptr) {
      const base::Error error =
          document ? base::Error{ErrorCode::kBadModel, "no part of it can be read", ""}
                   : document.error();
      for (std::size_t i = first; i < end; ++i) {
        context_.Warn("the model \"" + NameOf(distinct_[i]) + "\" is ignored: " + error.Sentence(),
                      Place(*distinct_[i].element));
      }
      return;
    }
    if (has_surroundings) TakeSurroundings(*world);
    for (std::size_t i = first; i < end; ++i) TakeParsed(*world, distinct_[i]);
  }

  static std::string NameOf(const Distinct& distinct) {
    const char* name = distinct.element->Attribute("name");
    return name == nullptr ? "" : name;
  }

  // Returns an SDFormat document with the models from `first` to `end` of distinct_, and with
  // surroundings_ (lights and elements of the world) if wanted. The elements are in the order of
  // their lines, as LineKeepingPrinter requires.
  std::string Document(std::size_t first, std::size_t end, bool with_surroundings) const {
    std::vector<const XMLElement*> elements;
    if (with_surroundings) elements.assign(surroundings_.begin(), surroundings_.end());
    for (std::size_t i = first; i < end; ++i) elements.push_back(distinct_[i].element);
    base::Sort(elements,
               [](const auto* a, const auto* b) { return a->GetLineNum() < b->GetLineNum(); });
    LineKeepingPrinter printer;
    printer.Text("<sdf version='" + file_.version + "'><world name=\"");
    // libsdformat refuses worlds with reserved names. The document's name is not used elsewhere.
    const bool reserved = world_.name == "world" || world_.name.find("::") != std::string::npos ||
                          world_.name.rfind("__", 0) == 0;
    printer.Escaped(reserved ? "unnamed" : world_.name.c_str());
    printer.Text("\">");
    for (const XMLElement* element : elements) printer.Element(*element);
    printer.Text("</world></sdf>");
    return printer.Take();
  }

  void TakeSurroundings(const sdf::World& world) {
    ReadPhysicsAndScene(world, context_, world_);
    for (PlacedLight& placed : lights_) {
      if (const sdf::Light* light = LightNamed(world, placed.light.name)) {
        placed.light = ReadLight(*light, context_);
      }
    }
  }

  static const sdf::Light* LightNamed(const sdf::World& world, const std::string& name) {
    for (std::uint64_t i = 0; i < world.LightCount(); ++i) {
      if (world.LightByIndex(i)->Name() == name) return world.LightByIndex(i);
    }
    return nullptr;
  }

  void TakeParsed(const sdf::World& world, Distinct& distinct) {
    const sdf::Model* model = world.ModelByName(NameOf(distinct));
    if (model == nullptr) {
      context_.Warn("the model \"" + NameOf(distinct) + "\" is ignored", Place(*distinct.element));
      return;
    }
    auto framed = formats::ReadModel(*model, context_);
    if (framed) {
      const auto script = scripts_.find(distinct.element);
      if (script != scripts_.end()) framed->model = ActorOf(*framed->model, script->second);
      framed->model =
          WithControlSystems(*distinct.element, file_.path, std::move(framed->model), problems_);
      framed->model =
          WithMimics(*distinct.element, file_.path, std::move(framed->model), problems_);
      distinct.framed = std::move(*framed);
    } else {
      context_.Warn(framed.error().message + "; it is ignored", Place(*distinct.element));
    }
  }

  const FramedModel* FramedOf(const Placement& placement) const {
    if (placement.stored != nullptr) return &placement.stored->framed;
    const auto& framed = distinct_[placement.distinct].framed;
    return framed ? &*framed : nullptr;
  }

  // Returns the inverse of the placement frame's pose in the model.
  Pose FrameFromModel(const Placement& placement, const FramedModel& framed) {
    if (placement.placement_frame.empty()) return {};
    const auto it = framed.model_from_frame.find(placement.placement_frame);
    if (it != framed.model_from_frame.end()) return geometry::Inverse(it->second);
    if (placement.placement_frame == "__model__") return {};
    context_.Warn(
        "there is no frame \"" + placement.placement_frame + "\" in the model for its pose",
        placement.place);
    return {};
  }

  void PlaceModels() {
    for (Placement& placement : placements_) {
      const FramedModel* framed = FramedOf(placement);
      if (framed == nullptr) continue;
      if (placement.uses_own_pose && placement.placement_frame.empty()) {
        placement.at.pose = framed->model->default_pose;
      } else if (placement.stored != nullptr && placement.placement_frame.empty()) {
        placement.placement_frame = framed->placement_frame;
      }
      frames_.Add(placement.name, placement.at, FrameFromModel(placement, *framed),
                  &framed->model_from_frame);
    }
    for (const Placement& placement : placements_) {
      const FramedModel* framed = FramedOf(placement);
      if (framed == nullptr) continue;
      auto world_from_model = frames_.WorldFrom(placement.name);
      if (!world_from_model) {
        context_.Warn(world_from_model.error().message + "; the origin is used", placement.place);
      }
      const auto& script = framed->model->script;
      const Pose start = script == nullptr ? Pose{} : model::StartPose(*script);
      if (state_.IsDeleted(placement.name)) continue;
      world_.models.push_back({placement.name, framed->model,
                               world_from_model.value_or(Pose{}) * start,
                               placement.is_static.value_or(framed->model->is_static)});
      state_.Apply(world_.models.back(), context_);
    }
  }

  void PlaceLights() {
    for (PlacedLight& placed : lights_) {
      auto world_from_light = frames_.WorldFrom(placed.at);
      if (!world_from_light) context_.Warn(world_from_light.error().message, placed.place);
      placed.light.world_from_light = world_from_light.value_or(placed.at.pose);
      if (const auto saved = state_.LightPose(placed.light.name)) {
        placed.light.world_from_light = *saved;
      }
      if (state_.IsDeleted(placed.light.name)) continue;
      world_.lights.push_back(std::move(placed.light));
    }
    state_.ReportMissing(world_, context_);
  }

  XmlFile& file_;
  ModelStore& store_;
  base::Problems& problems_;
  ReadingContext context_;
  IncludeScan scan_;
  WorldDescription world_;
  WorldState state_;
  WorldFrames frames_;
  std::vector<Placement> placements_;
  std::deque<Distinct> distinct_;
  std::map<std::string, std::size_t> distinct_by_text_;
  // The key is the element of an actor, changed to a <model>. This map is never iterated, because
  // pointers have no fixed order.
  std::map<const XMLElement*, ActorParts> scripts_;
  std::vector<PlacedLight> lights_;
  std::vector<XMLElement*> surroundings_;
  std::set<std::string> names_;
  std::set<const StoredFile*> reported_;
  std::set<std::filesystem::path> refused_;  // included files whose problems were already reported
};

}  // namespace

base::Result<WorldDescription> ReadWorld(XmlFile& file, ModelStore& store,
                                         base::Problems& problems) {
  return WorldReader(file, store, problems).Read();
}

}  // namespace gsv::formats
