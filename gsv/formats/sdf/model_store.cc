#include "gsv/formats/sdf/model_store.h"

#include <sdf/Light.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>

#include "gsv/formats/sdf/include_scan.h"
#include "gsv/formats/sdf/joint_mimic.h"
#include "gsv/formats/sdf/ros2_control.h"
#include "gsv/formats/sdf/sdf_actor.h"
#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_world.h"
#include "gsv/formats/sdf/urdf_text.h"
#include "gsv/formats/sdf/value_repair.h"
#include "gsv/formats/support/naming_rules.h"
#include "gsv/model/drive_guess.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using tinyxml2::XMLElement;

void Append(const std::string& plugins, XMLElement& model) {
  if (plugins.empty()) return;
  tinyxml2::XMLDocument document;
  document.Parse(("<plugins>" + plugins + "</plugins>").c_str());
  if (document.RootElement() == nullptr) return;
  for (auto* plugin = document.RootElement()->FirstChildElement(); plugin != nullptr;
       plugin = plugin->NextSiblingElement()) {
    model.InsertEndChild(plugin->DeepClone(model.GetDocument()));
  }
}

// Whether the problem is one of libsdformat's errors about the frames of a model without links.
// Such an error does not help to find the reason.
bool IsOfFrameGraphs(const base::Problem& problem) {
  return problem.message.rfind("FrameAttachedToGraph", 0) == 0 ||
         problem.message.rfind("Graph has", 0) == 0;
}

}  // namespace

base::Result<std::shared_ptr<const StoredFile>> ModelStore::Read(const std::filesystem::path& file,
                                                                 const std::string& plugins) {
  return ReadOnce(file, plugins, [&](StoredFile& stored) -> base::Status {
    auto xml = ReadXml(file, finder_, limits_, stored.problems);
    if (!xml) return Fail(xml.error());
    return ReadUncached(*xml, plugins, stored);
  });
}

base::Result<std::shared_ptr<const StoredFile>> ModelStore::Take(XmlFile xml,
                                                                 base::Problems problems) {
  return ReadOnce(xml.named, "", [&](StoredFile& stored) {
    stored.problems = std::move(problems);
    return ReadUncached(xml, "", stored);
  });
}

base::Result<std::shared_ptr<const StoredFile>> ModelStore::ReadOnce(
    const std::filesystem::path& file, const std::string& plugins,
    const std::function<base::Status(StoredFile&)>& read) {
  const auto name = std::make_pair(file.string(), plugins);
  if (const auto it = by_name_.find(name); it != by_name_.end()) return it->second;
  std::error_code ignored;
  const auto key = std::make_pair(std::filesystem::weakly_canonical(file, ignored), plugins);
  auto& known = files_[key];
  if (known == nullptr) {
    StoredFile stored;
    if (auto status = read(stored); !status) {
      problems_of_refused_ = std::move(stored.problems);
      return Fail(status.error());
    }
    known = std::make_shared<const StoredFile>(std::move(stored));
  }
  return by_name_[name] = known;
}

base::Status ModelStore::ReadUncached(XmlFile& xml, const std::string& plugins,
                                      StoredFile& stored) {
  const std::filesystem::path& file = xml.named;
  if (check_rules_) CheckNamingRules({xml.path, xml.root, xml.minor_version}, stored.broken_rules);
  if (xml.dialect == XmlDialect::kUrdf) {
    ReportUnsupported(xml, stored.problems);
    std::string text = UrdfText(xml, stored.problems);
    auto status = FromText({file, std::move(text)}, {}, stored);
    if (status) Complete(*xml.root, file, true, stored);
    return status;
  }
  ReportUnsupported(xml, stored.problems);
  XMLElement* content = xml.root->FirstChildElement("model");
  if (content == nullptr) content = xml.root->FirstChildElement("light");
  ActorParts actor;
  if (content == nullptr) {
    content = xml.root->FirstChildElement("actor");
    if (content != nullptr) actor = MakeModelOfActor(*content, ContextFor(file, stored.problems));
  }
  if (content == nullptr) {
    const bool world = xml.root->FirstChildElement("world") != nullptr;
    return Fail(
        ErrorCode::kBadModel,
        world ? "the file contains a world, but a model is required" : "the file contains no model",
        PlaceOf(file, *xml.root));
  }
  RepairValues(*content, file, stored.problems);
  IncludeScan includes(finder_, limits_, stored.problems);
  includes.Scan(*content, file);
  if (std::string(content->Name()) == "model") Append(plugins, *content);

  LineKeepingPrinter printer;
  printer.Text("<sdf version='" + xml.version + "'>");
  printer.Element(*content);
  printer.Text("</sdf>");
  auto status = FromText({file, printer.Take()}, includes.files(), stored);
  if (!status) return status;
  if (actor.script != nullptr) stored.framed.model = ActorOf(*stored.framed.model, actor);
  Complete(*content, file, false, stored);
  return {};
}

void ModelStore::Complete(const XMLElement& element, const std::filesystem::path& file,
                          bool is_robot, StoredFile& stored) {
  if (stored.framed.model == nullptr) return;
  stored.framed.model =
      WithControlSystems(element, file, std::move(stored.framed.model), stored.problems);
  stored.framed.model = WithMimics(element, file, std::move(stored.framed.model), stored.problems);
  if (!is_robot || stored.framed.model->drive) return;
  auto drive = model::GuessDrive(*stored.framed.model);
  if (drive.kind == model::DriveKind::kNone) return;
  model::Model driven = *stored.framed.model;
  driven.drive = std::move(drive);
  stored.framed.model = std::make_shared<const model::Model>(std::move(driven));
}

base::Status ModelStore::FromText(const SdfText& text, const IncludedFiles& includes,
                                  StoredFile& stored) {
  auto document = ParseSdf(text, includes, stored.problems);
  if (!document) return Fail(document.error());
  const ReadingContext context = ContextFor(text.path, stored.problems);
  if (const sdf::Model* model = document->root->Model()) {
    auto framed = formats::ReadModel(*model, context);
    if (!framed) {
      std::erase_if(stored.problems, IsOfFrameGraphs);
      return Fail(framed.error());
    }
    stored.framed = std::move(*framed);
  } else if (const sdf::Light* light = document->root->Light()) {
    stored.light = ReadLight(*light, context);
    stored.world_from_light = FromIgnition(light->RawPose());
  } else {
    return Fail(ErrorCode::kBadModel, "the file contains no model", text.path.string());
  }
  return {};
}

}  // namespace gsv::formats
