#include "gsv/formats/sdf_reader.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>
#include <variant>

#include "gsv/base/mutex.h"
#include "gsv/base/spelling.h"
#include "gsv/formats/sdf/builtin_models.h"
#include "gsv/formats/sdf/model_store.h"
#include "gsv/formats/sdf/named_poses.h"
#include "gsv/formats/sdf/shape_model.h"
#include "gsv/formats/sdf/world_reader.h"
#include "gsv/formats/support/naming_rules.h"
#include "gsv/formats/xacro/arguments.h"
#include "gsv/model/drive_choice.h"
#include "gsv/model/script.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;
using model::Model;
using model::WorldDescription;

bool HasPlaneToCollideWith(const Model& model) {
  return std::any_of(model.links.begin(), model.links.end(), [](const model::Link& link) {
    return std::any_of(link.collisions.begin(), link.collisions.end(), [](const auto& collision) {
      return std::holds_alternative<geometry::Plane>(collision.shape);
    });
  });
}

base::Result<fs::path> FileAt(const fs::path& path) {
  std::error_code ignored;
  const xacro::NamedFile named = xacro::SplitArguments(path.string());
  if (!named.arguments.empty() && fs::exists(named.file, ignored)) {
    return fs::path(xacro::AsPath(path.string()));
  }
  if (fs::is_directory(path, ignored)) return ModelFileIn(path);
  if (fs::exists(path, ignored)) return path;
  return Fail(ErrorCode::kBadModel, "there is no such file", path.string());
}

}  // namespace

class ModelLibrary::Reader {
 public:
  explicit Reader(const ReadOptions& options) : drives_(options.drives), store_(options) {}

  base::Result<WorldDescription> ReadWorldAt(const fs::path& path, base::Problems& problems) {
    const base::MutexLock lock(mutex_);
    auto file = FileAt(path);
    if (!file) return Fail(file.error());
    auto xml = ReadXml(*file, store_.finder(), store_.limits(), problems);
    if (!xml) return Fail(xml.error());
    if (xml->root->FirstChildElement("world") == nullptr) {
      return ReadEnvironment(*std::move(xml), problems);
    }
    ReportUnsupported(*xml, problems);
    base::Problems broken_rules;
    if (store_.checks_rules()) {
      CheckNamingRules({xml->path, xml->root, xml->minor_version}, broken_rules);
    }
    auto world = formats::ReadWorld(*xml, store_, problems);
    problems.insert(problems.end(), broken_rules.begin(), broken_rules.end());
    return world;
  }

  base::Result<std::vector<NamedPose>> ReadNamedPosesOf(const WorldDescription& world) {
    const base::MutexLock lock(mutex_);
    base::Problems known;  // problems that were reported when the world was read
    auto xml = ReadXml(world.source, store_.finder(), store_.limits(), known);
    if (!xml) return Fail(xml.error());
    const auto* const element = xml->root->FirstChildElement("world");
    return element == nullptr ? std::vector<NamedPose>() : NamedPosesIn(*element, world);
  }

  base::Result<std::shared_ptr<const Model>> ReadModelNamed(const std::string& name,
                                                            const fs::path& named_in,
                                                            base::Problems& problems) {
    const base::MutexLock lock(mutex_);
    if (IsShapeName(name)) return ReadShape(name, problems);
    auto file = FileOf(name, named_in);
    if (!file) return Fail(file.error());
    auto model = ReadStored(*file, problems);
    if (!model) return model;
    const auto drive = drives_.find((*model)->name);
    if (drive == drives_.end()) return model;
    auto& driven = driven_[*model];
    if (driven == nullptr) {
      auto robot = model::AsRobot(*model, drive->second);
      if (!robot) return Fail(robot.error());
      driven = *std::move(robot);
    }
    return driven;
  }

 private:
  base::Result<fs::path> FileOf(const std::string& name, const fs::path& named_in) const
      GSV_REQUIRES(mutex_) {
    std::error_code ignored;
    if (name.empty()) return Fail(ErrorCode::kBadModel, "the name of a model is empty");
    if (fs::exists(xacro::FilePart(name), ignored)) return FileAt(name);
    const bool has_scheme = name.find("://") != std::string::npos;
    auto found = store_.finder().Find(has_scheme ? name : "model://" + name, named_in);
    if (!found) {
      return Fail(ErrorCode::kBadModel, "there is no model \"" + name +
                                            "\": there is no such file, and no model of that name "
                                            "beside the world or on the model path" +
                                            base::DidYouMean(name, store_.finder().ModelNames()));
    }
    return FileAt(*found);
  }

  base::Result<std::shared_ptr<const Model>> ReadShape(const std::string& name,
                                                       base::Problems& problems)
      GSV_REQUIRES(mutex_) {
    const auto text = SdfOfShape(name);
    if (!text) return Fail(text.error());
    XmlFile xml;
    xml.path = xml.named = name;
    xml.version = "1.9";
    xml.minor_version = 9;
    xml.document = std::make_unique<tinyxml2::XMLDocument>();
    xml.document->Parse(text->data(), text->size());
    xml.root = xml.document->RootElement();
    return ModelOf(store_.Take(std::move(xml), {}), name, problems);
  }

  base::Result<std::shared_ptr<const Model>> ReadStored(const fs::path& file,
                                                        base::Problems& problems)
      GSV_REQUIRES(mutex_) {
    return ModelOf(store_.Read(file), file, problems);
  }

  base::Result<std::shared_ptr<const Model>> ModelOf(
      const base::Result<std::shared_ptr<const StoredFile>>& stored, const fs::path& file,
      base::Problems& problems) GSV_REQUIRES(mutex_) {
    if (!stored) {
      const base::Problems reasons = store_.TakeProblemsOfRefused();
      problems.insert(problems.end(), reasons.begin(), reasons.end());
      return Fail(stored.error());
    }
    const StoredFile& read = **stored;
    problems.insert(problems.end(), read.problems.begin(), read.problems.end());
    problems.insert(problems.end(), read.broken_rules.begin(), read.broken_rules.end());
    if (read.framed.model == nullptr) {
      return Fail(ErrorCode::kBadModel, "the file contains a light, but a model is required",
                  file.string());
    }
    return read.framed.model;
  }

  base::Result<WorldDescription> ReadEnvironment(XmlFile xml, base::Problems& problems)
      GSV_REQUIRES(mutex_) {
    const fs::path file = xml.named;
    auto model = ModelOf(store_.Take(std::move(xml), std::exchange(problems, {})), file, problems);
    if (!model) return Fail(model.error());
    XmlFile environment;
    environment.path = file;
    environment.version = "1.9";
    environment.document = std::make_unique<tinyxml2::XMLDocument>();
    const std::string_view text = EnvironmentWorld(!HasPlaneToCollideWith(**model));
    environment.document->Parse(text.data(), text.size());
    environment.root = environment.document->RootElement();
    auto world = formats::ReadWorld(environment, store_, problems);
    if (!world) return world;
    world->name = (*model)->name;
    std::string name = (*model)->name;
    for (const model::PlacedModel& other : world->models) {
      if (other.name == name) name += "_1";
    }
    const auto& script = (*model)->script;
    const geometry::Pose start = script == nullptr ? geometry::Pose{} : model::StartPose(*script);
    world->models.push_back({name, *model, (*model)->default_pose * start, (*model)->is_static});
    return world;
  }

  base::Mutex mutex_;
  const std::map<std::string, std::string> drives_;
  // Copies of models with the drives of ReadOptions. The key is the model as it was read from the
  // file.
  std::map<std::shared_ptr<const Model>, std::shared_ptr<const Model>> driven_
      GSV_GUARDED_BY(mutex_);
  ModelStore store_ GSV_GUARDED_BY(mutex_);
};

ModelLibrary::ModelLibrary(ReadOptions options) : reader_(std::make_unique<Reader>(options)) {}
ModelLibrary::~ModelLibrary() = default;

base::Result<WorldDescription> ModelLibrary::ReadWorld(const fs::path& path,
                                                       base::Problems& problems) {
  return reader_->ReadWorldAt(path, problems);
}

base::Result<std::vector<NamedPose>> ModelLibrary::ReadNamedPoses(const WorldDescription& world) {
  return reader_->ReadNamedPosesOf(world);
}

base::Result<std::shared_ptr<const Model>> ModelLibrary::ReadModel(const std::string& name_or_path,
                                                                   base::Problems& problems,
                                                                   const fs::path& named_in) {
  return reader_->ReadModelNamed(name_or_path, named_in, problems);
}

}  // namespace gsv::formats
