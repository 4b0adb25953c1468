#include "gsv/formats/world_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include <tinyxml2.h>

#include "gsv/formats/sdf/builtin_models.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/shape_model.h"
#include "gsv/formats/sdf/world_frames.h"
#include "gsv/formats/sdf/world_state.h"
#include "gsv/formats/xacro/arguments.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::Problem;
using geometry::Pose;
using model::PlacedModel;
using tinyxml2::XMLElement;

// Elements whose text is the name of a file.
constexpr const char* kFileElements[]{"uri",           "filename",        "albedo_map",
                                      "normal_map",    "light_map",       "roughness_map",
                                      "metalness_map", "glossiness_map",  "specular_map",
                                      "emissive_map",  "environment_map", "ambient_occlusion_map"};
// The path of a world file in a folder that has no models. If a world file at this path can refer
// to a model by some name, a world file in any folder can.
constexpr const char* kNowhere = "/gsv-nowhere/world.sdf";
constexpr int kMaxDepth = 256;

std::string ShortText(double number) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return {text, end};
}

std::string Joined(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + ShortText(number);
  return text;
}

const char* ChildText(const XMLElement& element, const char* child) {
  const XMLElement* const found = element.FirstChildElement(child);
  const char* const text = found == nullptr ? nullptr : found->GetText();
  return text == nullptr ? "" : text;
}

bool IsSameModel(const model::Model& a, const model::Model& b) {
  return &a == &b || (!a.source.empty() && a.source == b.source && a.name == b.name);
}

// Returns the number and its neighbouring doubles, the nearest first.
std::vector<double> Neighbours(double number) {
  constexpr int kSteps = 4;
  std::vector<double> numbers{number};
  double below = number, above = number;
  for (int i = 0; i < kSteps; ++i) {
    numbers.push_back(below = std::nextafter(below, -4.0));
    numbers.push_back(above = std::nextafter(above, 4.0));
  }
  return numbers;
}

// Returns roll, pitch and yaw that convert to exactly `q`. Returns nullopt if no numbers near the
// angles of `q` convert to it.
std::optional<geometry::RollPitchYaw> AnglesOf(const geometry::Quaternion& q) {
  const geometry::RollPitchYaw angles = geometry::ToRollPitchYaw(q);
  for (const double roll : Neighbours(angles.roll)) {
    for (const double pitch : Neighbours(angles.pitch)) {
      for (const double yaw : Neighbours(angles.yaw)) {
        const geometry::RollPitchYaw tried{roll, pitch, yaw};
        if (geometry::FromRollPitchYaw(tried) == q) return tried;
      }
    }
  }
  return std::nullopt;
}

// Whether the world has a ground plane. ReadWorld() adds a ground plane to the world that it makes
// for a single model.
bool HasGroundPlane(const model::WorldDescription& world) {
  return std::any_of(world.models.begin(), world.models.end(),
                     [](const PlacedModel& placed) { return placed.name == "ground_plane"; });
}

class WorldWriter {
 public:
  WorldWriter(const model::WorldDescription& original, const ReadOptions& options,
              base::Problems& problems)
      : original_(original),
        limits_(options.limits),
        finder_(options.model_path),
        problems_(problems) {}

  base::Result<std::string> Write(const std::vector<PlacedModel>& models,
                                  const geometry::Vector3& gravity) {
    if (auto ok = Open(); !ok) return Fail(ok.error());
    TakeStates();
    NameElements();
    for (XMLElement* const element : gone_) world_->DeleteChild(element);
    KeepTemplates();
    MakeNamesAbsolute(*world_, kMaxDepth);
    PlaceLights();
    std::set<std::string> kept;
    for (const PlacedModel& placed : models) {
      if (Keep(placed)) kept.insert(placed.name);
    }
    for (const auto& [name, element] : elements_) {
      if (!kept.contains(name)) world_->DeleteChild(element);
    }
    for (const PlacedModel& placed : models) {
      if (!kept.contains(placed.name)) Add(placed);
    }
    if (!(gravity == original_.gravity))
      SetText(*world_, "gravity", Joined({gravity.x, gravity.y, gravity.z}));
    WarnOfPaths();
    tinyxml2::XMLPrinter printer;
    file_.document->Print(&printer);
    return std::string(printer.CStr());
  }

 private:
  void Warn(const std::string& message, const std::string& where) {
    problems_.push_back({Problem::Severity::kWarning, message, where});
  }

  // Opens the world's file. If the world has no file, it was made for a single model, or by a
  // program.
  base::Status Open() {
    std::error_code ignored;
    const bool has_file =
        !original_.source.empty() && fs::exists(xacro::FilePart(original_.source), ignored);
    if (!has_file && !original_.source.empty()) {
      return base::Fail(base::ErrorCode::kBadModel, "the file of the world does not exist any more",
                        original_.source);
    }
    if (has_file) {
      base::Problems unused;
      auto file = ReadXml(original_.source, finder_, limits_, unused);
      if (!file) return Fail(file.error());
      file_ = *std::move(file);
      world_ = file_.root->FirstChildElement("world");
      if (world_ != nullptr) return {};
    }
    const std::string_view text = EnvironmentWorld(HasGroundPlane(original_));
    file_.document = std::make_unique<tinyxml2::XMLDocument>();
    file_.document->Parse(text.data(), text.size());
    file_.root = file_.document->RootElement();
    world_ = file_.root->FirstChildElement("world");
    return {};
  }

  const PlacedModel* Original(const std::string& name) const {
    const auto found = std::find_if(original_.models.begin(), original_.models.end(),
                                    [&](const PlacedModel& placed) { return placed.name == name; });
    return found == original_.models.end() ? nullptr : &*found;
  }

  // Returns the file to which an <include> refers; empty if it is not found.
  fs::path FileOfInclude(const XMLElement& include) const {
    auto found = finder_.Find(ChildText(include, "uri"), original_.source);
    if (!found) return {};
    std::error_code ignored;
    if (!fs::is_directory(*found, ignored)) return *found;
    const auto file = ModelFileIn(*found);
    return file ? *file : fs::path();
  }

  std::string NameOfInclude(const XMLElement& include) const {
    const fs::path file = FileOfInclude(include);
    if (file.empty()) return {};
    const std::string name = ChildText(include, "name");
    for (const PlacedModel& placed : original_.models) {
      std::error_code ignored;
      if (!fs::equivalent(file, xacro::FilePart(placed.model->source), ignored)) continue;
      return name.empty() ? placed.model->name : name;
    }
    return {};
  }

  // Gives the elements the names that the reader gives them: included models first, and a second
  // model with the same name gets a number.
  void NameElements() {
    for (XMLElement* const include : ChildrenOf("include")) {
      const std::string name = NameOfInclude(*include);
      if (!name.empty()) Name(name, *include);
    }
    for (auto* child = world_->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind == "model" || kind == "actor") {
        const char* const name = child->Attribute("name");
        Name(name == nullptr ? "unnamed" : name, *child);
      } else if (kind == "include" && !finder_.Find(ChildText(*child, "uri"), original_.source)) {
        const std::string_view text = BuiltInModel(ChildText(*child, "uri"));
        if (text.find("<model") == std::string_view::npos) continue;
        const std::string name = ChildText(*child, "name");
        Name(name.empty() ? "ground_plane" : name, *child);
      }
    }
  }

  void Name(const std::string& wanted, XMLElement& element) {
    std::string name = wanted;
    for (int i = 1; !names_.insert(name).second; ++i) name = wanted + "_" + std::to_string(i);
    if (deleted_.contains(name)) gone_.push_back(&element);
    if (Original(name) == nullptr) return;
    elements_[name] = &element;
    if (name != wanted) Rename(element, name);
  }

  static bool IsInclude(const XMLElement& element) {
    return std::string(element.Name()) == "include";
  }

  static void Rename(XMLElement& element, const std::string& name) {
    if (IsInclude(element)) {
      SetText(element, "name", name);
    } else {
      element.SetAttribute("name", name.c_str());
    }
  }

  // Stores copies of the elements, because a model may be copied after its original was removed.
  void KeepTemplates() {
    for (const auto& [name, element] : elements_) {
      templates_[name] = element->DeepClone(file_.document.get())->ToElement();
    }
  }

  std::vector<XMLElement*> ChildrenOf(const char* kind) const {
    std::vector<XMLElement*> children;
    for (auto* child = world_->FirstChildElement(kind); child != nullptr;
         child = child->NextSiblingElement(kind)) {
      children.push_back(child);
    }
    return children;
  }

  // Removes the <state>s. The models and lights that they insert become a part of the world. The
  // poses in them are those of original_.
  void TakeStates() {
    for (XMLElement* const state : ChildrenOf("state")) {
      if (IsStateOf(*world_, *state)) {
        has_state_ = true;
        Warn("the <state> of the world is not saved: joints start at their initial positions",
             original_.source);
        TakeInsertions(*state, *world_);
        AddDeletions(*state, deleted_);
      }
      world_->DeleteChild(state);
    }
  }

  void PlaceLights() {
    for (XMLElement* const light : ChildrenOf("light")) {
      const char* const name = light->Attribute("name");
      if (name != nullptr && deleted_.contains(name)) {
        world_->DeleteChild(light);
        continue;
      }
      const auto found = std::find_if(
          original_.lights.begin(), original_.lights.end(),
          [&](const model::Light& each) { return name != nullptr && each.name == name; });
      if ((has_state_ || IsRelative(*light)) && found != original_.lights.end()) {
        SetPose(*light, found->world_from_light);
      }
    }
  }

  static bool IsRelative(const XMLElement& element) {
    const auto pose = ReadPose(element);
    return pose && !pose->relative_to.empty();
  }

  // Whether the file already has an element for this model. If so, the element stays, and this
  // function updates its <pose>.
  bool Keep(const PlacedModel& placed) {
    const auto found = elements_.find(placed.name);
    const PlacedModel* const original = Original(placed.name);
    if (found == elements_.end() || original == nullptr) return false;
    if (!IsSameModel(*original->model, *placed.model)) return false;
    const bool stands = original->world_from_model == placed.world_from_model;
    const bool is_actor =
        placed.model->script != nullptr;  // a script sets its pose, so <pose> stays
    if ((!stands || has_state_ || IsRelative(*found->second)) && !is_actor) {
      SetPose(*found->second, placed);
    }
    return true;
  }

  static void SetText(XMLElement& parent, const char* child, const std::string& text) {
    XMLElement* element = parent.FirstChildElement(child);
    if (element == nullptr) element = parent.InsertNewChildElement(child);
    element->SetText(text.c_str());
  }

  // As below, for the element of a model.
  void SetPose(XMLElement& element, const PlacedModel& placed) {
    SetPose(element, placed.world_from_model);
    if (!IsInclude(element) || !placed.model->has_placement_frame) return;
    // Otherwise, the frame that the included file names would be at the pose.
    SetText(element, "placement_frame", "__model__");
  }

  void SetPose(XMLElement& element, const Pose& pose) {
    while (auto* const old = element.FirstChildElement("pose")) element.DeleteChild(old);
    while (auto* const frame = element.FirstChildElement("placement_frame")) {
      element.DeleteChild(frame);
    }
    element.DeleteAttribute("placement_frame");
    XMLElement* const written = file_.document->NewElement("pose");
    // The pose comes after the URI and the name, as is usual in an <include>.
    XMLElement* const name = element.FirstChildElement("name");
    if (IsInclude(element) && name != nullptr) {
      element.InsertAfterChild(name, written);
    } else if (IsInclude(element)) {
      element.InsertEndChild(written);
    } else {
      element.InsertFirstChild(written);
    }
    const auto& [p, q] = pose;
    if (const auto angles = AnglesOf(q)) {
      written->SetText(Joined({p.x, p.y, p.z, angles->roll, angles->pitch, angles->yaw}).c_str());
      return;
    }
    // The reader normalizes the quaternion, so its last bits may differ when it is read.
    written->SetAttribute("rotation_format", "quat_xyzw");
    written->SetText(Joined({p.x, p.y, p.z, q.x, q.y, q.z, q.w}).c_str());
    file_.root->SetAttribute("version", "1.9");  // the first version with quaternions
  }

  void Add(const PlacedModel& placed) {
    XMLElement* const element = ElementFor(placed);
    if (element == nullptr) return;
    Rename(*element, placed.name);
    SetPose(*element, placed);
    if (placed.is_static != placed.model->is_static) {
      SetText(*element, "static", placed.is_static ? "true" : "false");
    }
    world_->InsertEndChild(element);
  }

  // Returns a new element for this model. If it cannot be written, adds a problem and returns null.
  XMLElement* ElementFor(const PlacedModel& placed) {
    const std::string& source = placed.model->source;
    if (IsShapeName(source)) return ShapeElement(source);
    for (const PlacedModel& original : original_.models) {
      const auto found = templates_.find(original.name);
      if (found == templates_.end() || !IsSameModel(*original.model, *placed.model)) continue;
      XMLElement* const copy = found->second->DeepClone(file_.document.get())->ToElement();
      MakeNamesAbsolute(*copy, kMaxDepth);
      return copy;
    }
    std::error_code ignored;
    if (source.empty() || !fs::exists(xacro::FilePart(source), ignored)) {
      Warn("the model is not saved, because it has no file", placed.name);
      return nullptr;
    }
    if (xacro::FilePart(source) != source) {
      Warn("Gazebo cannot read the model: the name of its file has arguments for xacro",
           placed.name);
    }
    XMLElement* const include = file_.document->NewElement("include");
    SetText(*include, "uri", UriOfFile(source));
    return include;
  }

  XMLElement* ShapeElement(const std::string& name) {
    const auto text = SdfOfShape(name);
    if (!text) {
      Warn(text.error().message, name);
      return nullptr;
    }
    tinyxml2::XMLDocument document;
    document.Parse(text->c_str());
    return document.RootElement()
        ->FirstChildElement("model")
        ->DeepClone(file_.document.get())
        ->ToElement();
  }

  // Returns the URI model://NAME or model://NAME/REST if it means this file in whatever folder the
  // world is saved. Else returns file:// and the absolute path.
  std::string UriOfFile(const std::string& source) const {
    const fs::path path = fs::absolute(xacro::FilePart(source)).lexically_normal();
    const std::string by_name = "model://" + path.parent_path().filename().string();
    const auto found = finder_.Find(by_name, kNowhere);
    if (found) {
      const auto file = ModelFileIn(*found);
      std::error_code ignored;
      if (file && fs::equivalent(*file, path, ignored)) return by_name;
    }
    if (xacro::FilePart(source) == source) {
      if (const std::string uri = ModelUriOf(path); !uri.empty()) return uri;
    }
    return "file://" + fs::absolute(source).lexically_normal().string();
  }

  // Returns model://NAME/REST if the file or folder is in a folder of the model path, else an empty
  // text.
  std::string ModelUriOf(const fs::path& path) const {
    std::error_code ignored;
    const fs::path file = fs::weakly_canonical(path, ignored);
    for (const fs::path& folder : finder_.search_path()) {
      const fs::path rest = file.lexically_relative(fs::weakly_canonical(folder, ignored));
      if (rest.empty() || *rest.begin() == ".." || *rest.begin() == ".") continue;
      const std::string uri = "model://" + rest.generic_string();
      const auto found = finder_.Find(uri, kNowhere);
      if (found && fs::equivalent(*found, file, ignored)) return uri;
    }
    return {};
  }

  // Warns of files that other computers do not have at the same path.
  void WarnOfPaths() {
    std::set<std::string> paths;
    CollectPaths(*world_, kMaxDepth, paths);
    if (paths.empty()) return;
    Warn("the world names " + std::to_string(paths.size()) +
             (paths.size() == 1 ? " file" : " files") + " by the path on this computer, such as " +
             *paths.begin() +
             ". To load it on another computer, put the folder that contains the model's folder on "
             "the model path (--model-path, or GZ_SIM_RESOURCE_PATH) and save again",
         original_.source);
  }

  void CollectPaths(const XMLElement& element, int levels_left,
                    std::set<std::string>& paths) const {
    if (levels_left == 0) return;
    const char* const text = NamesFile(element) ? element.GetText() : nullptr;
    constexpr std::string_view kScheme = "file://";
    if (text != nullptr && std::string_view(text).starts_with(kScheme)) {
      paths.emplace(text + kScheme.size());
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      CollectPaths(*child, levels_left - 1, paths);
    }
  }

  // Whether the text of the element is the name of a file.
  static bool NamesFile(const XMLElement& element) {
    return std::any_of(std::begin(kFileElements), std::end(kFileElements),
                       [&](const char* kind) { return std::string(element.Name()) == kind; });
  }

  void MakeNamesAbsolute(XMLElement& element, int levels_left) {
    if (levels_left == 0 || original_.source.empty()) return;
    if (NamesFile(element)) MakeNameAbsolute(element);
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      MakeNamesAbsolute(*child, levels_left - 1);
    }
  }

  void MakeNameAbsolute(XMLElement& element) const {
    const char* const text = element.GetText();
    if (text == nullptr || IsWebAddress(text)) return;
    const auto found = finder_.Find(text, original_.source);
    if (!found) return;
    const auto elsewhere = finder_.Find(text, kNowhere);
    std::error_code ignored;
    if (elsewhere && fs::equivalent(*found, *elsewhere, ignored)) return;
    if (const std::string uri = ModelUriOf(*found); !uri.empty()) {
      element.SetText(uri.c_str());
      return;
    }
    element.SetText(("file://" + fs::absolute(*found).lexically_normal().string()).c_str());
  }

  const model::WorldDescription& original_;
  const ReadLimits limits_;
  const ResourceFinder finder_;
  base::Problems& problems_;
  XmlFile file_;
  XMLElement* world_ = nullptr;
  bool has_state_ = false;         // whether the world had a <state>
  std::set<std::string> deleted_;  // names of models and lights that the <state> deletes
  std::vector<XMLElement*> gone_;  // the elements of these models
  std::set<std::string> names_;
  std::map<std::string, XMLElement*> elements_;   // elements of the file, by their names
  std::map<std::string, XMLElement*> templates_;  // copies of these elements, owned by the document
};

}  // namespace

base::Result<std::string> WriteWorld(const model::WorldDescription& original,
                                     const std::vector<PlacedModel>& models,
                                     const geometry::Vector3& gravity, const ReadOptions& options,
                                     base::Problems& problems) {
  return WorldWriter(original, options, problems).Write(models, gravity);
}

}  // namespace gsv::formats
