#include "gsv/formats/sdf/sdf_document.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <console_bridge/console.h>
#include <sdf/Console.hh>
#include <sdf/Element.hh>
#include <sdf/Error.hh>
#include <sdf/Exception.hh>
#include <sdf/Param.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/SDFImpl.hh>
#include <sdf/parser.hh>

#include "gsv/formats/sdf/document_repair.h"
#include "gsv/formats/sdf/sdf_schema.h"
#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {
namespace {

using base::Problem;

// maximum number of repairs of one document; each requires another parse
constexpr int kMaxRepairs = 64;
constexpr std::size_t kMaxMessageLength = 300;
// maximum number of schemas that are kept
constexpr std::size_t kMaxSchemas = 8;

// `file` is the file name in an error of libsdformat. Returns whether it names no real file: it is
// empty, or is libsdformat's name for text in memory, "<data-string>" or "<urdf-string>".
bool IsNoFile(const std::string& file) { return file.empty() || file.front() == '<'; }

// Stores the errors of urdfdom: libsdformat does not pass them on.
class ReasonKeeper : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && reasons.size() < kMaxReasons) {
      reasons.push_back(text);
    }
  }
  std::vector<std::string> reasons;

 private:
  static constexpr std::size_t kMaxReasons = 20;
};

ReasonKeeper& Reasons() {
  static ReasonKeeper keeper;
  return keeper;
}

std::string Shortened(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  if (text.size() > kMaxMessageLength) text = text.substr(0, kMaxMessageLength) + "…";
  return text;
}

// The result of parsing a document once.
struct Reading {
  std::unique_ptr<sdf::Root> root = std::make_unique<sdf::Root>();
  sdf::Errors errors;
  std::string exception;  // message of an exception of libsdformat

  bool HasContent() const {
    return root->WorldCount() > 0 || root->Model() != nullptr || root->Light() != nullptr ||
           root->Actor() != nullptr;
  }
};

// Changes libsdformat's global configuration so that included files come from `server`. libsdformat
// 12 uses the caller's own configuration only for the main file, and not for included files.
void ConfigureBy(IncludedFileServer& server) {
  sdf::ParserConfig& config = sdf::ParserConfig::GlobalConfig();
  config.SetFindCallback([&server](const std::string& uri) { return server.Find(uri); });
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
}

// libsdformat reads some included texts from memory, under the names that
// IncludedFileServer::Find() returned. Replaces these names by the paths of the included files, so
// that errors have the paths.
void NameSources(const sdf::ElementPtr& element, const IncludedFileServer& server) {
  if (element == nullptr) return;
  if (const auto* source = server.SourceOf(element->FilePath())) {
    element->SetFilePath(source->string());
  }
  for (auto child = element->GetFirstElement(); child != nullptr; child = child->GetNextElement()) {
    NameSources(child, server);
  }
}

// Returns libsdformat's schema without the descriptions of those large elements that do not occur
// in the text. This saves time, because libsdformat copies the descriptions of an element's
// children whenever it reads the element. Leaving them out is safe: none of these elements is
// required, and libsdformat creates them only from URDF.
sdf::ElementPtr SchemaFor(const std::string& text) GSV_REQUIRES(SdformatMutex()) {
  // schemas by the set of omitted elements
  static std::map<std::set<std::string>, sdf::ElementPtr> schemas;
  std::set<std::string> absent;
  if (text.find("<sdf") != std::string::npos) {
    for (const char* name :
         {"actor", "joint", "particle_emitter", "population", "sensor", "state"}) {
      if (text.find("<" + std::string(name)) == std::string::npos) absent.insert(name);
    }
  }
  if (absent.empty()) return SdfSchema();
  if (schemas.size() >= kMaxSchemas && !schemas.contains(absent)) schemas.clear();
  sdf::ElementPtr& schema = schemas[absent];
  if (schema == nullptr) schema = MakeSdfSchema(absent);
  return schema;
}

// Returns an <sdf> element without content, ready for reading. It shares the descriptions of the
// schema. This is safe, because libsdformat copies a description before it fills an element.
sdf::SDFPtr EmptyDocument(const sdf::Element& schema) {
  const auto root = std::make_shared<sdf::Element>();
  root->SetName(schema.GetName());
  root->SetRequired(schema.GetRequired());
  root->SetDescription(schema.GetDescription());
  for (unsigned i = 0; i < schema.GetAttributeCount(); ++i) {
    const sdf::ParamPtr attribute = schema.GetAttribute(i);
    root->AddAttribute(attribute->GetKey(), attribute->GetTypeName(),
                       attribute->GetDefaultAsString(), attribute->GetRequired(),
                       attribute->GetDescription());
  }
  for (unsigned i = 0; i < schema.GetElementDescriptionCount(); ++i) {
    root->AddElementDescription(schema.GetElementDescription(i));
  }
  const sdf::SDFPtr document(new sdf::SDF);
  document->Root(root);
  return document;
}

// Does the same as sdf::Root::LoadSdfString, which would build the schema again for each text.
sdf::Errors Load(const std::string& text, sdf::Root& root) GSV_REQUIRES(SdformatMutex()) {
  const sdf::ParserConfig& config = sdf::ParserConfig::GlobalConfig();
  const sdf::SDFPtr document = EmptyDocument(*SchemaFor(text));
  sdf::Errors errors;
  if (!sdf::readString(text, config, document, errors)) {
    errors.emplace_back(sdf::ErrorCode::STRING_READ, "");
    return errors;
  }
  const sdf::Errors more = root.Load(document, config);
  errors.insert(errors.end(), more.begin(), more.end());
  return errors;
}

Reading ReadOnce(const std::string& text, const IncludedFiles& includes)
    GSV_REQUIRES(SdformatMutex()) {
  Reading reading;
  IncludedFileServer server(includes);
  ConfigureBy(server);
  Reasons().reasons.clear();
  try {
    reading.errors = Load(text, *reading.root);
  } catch (const sdf::Exception& exception) {  // sdf::Exception does not derive from std::exception
    reading.exception = exception.GetErrorStr();
  } catch (const std::exception& exception) {
    reading.exception = exception.what();
  } catch (...) {
    reading.exception = "an unknown exception";
  }
  if (!reading.exception.empty() && !reading.HasContent()) {
    reading.root = std::make_unique<sdf::Root>();
  }
  for (sdf::Error& error : reading.errors) {
    if (!error.FilePath()) continue;
    if (const auto* source = server.SourceOf(*error.FilePath())) {
      error.SetFilePath(source->string());
    }
  }
  NameSources(reading.root->Element(), server);
  sdf::ParserConfig::GlobalConfig().SetFindCallback({});
  return reading;
}

std::string ErrorPlace(const sdf::Error& error, const std::filesystem::path& source) {
  std::string file = error.FilePath().value_or("");
  if (IsNoFile(file)) file = source.string();
  std::string place = file;
  if (error.LineNumber().value_or(0) > 0) place += ":" + std::to_string(*error.LineNumber());
  if (error.XmlPath() && !error.XmlPath()->empty()) place += ": " + *error.XmlPath();
  return place;
}

bool BreaksFrames(const sdf::Error& error) {
  const sdf::ErrorCode code = error.Code();
  return code == sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR ||
         code == sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR;
}

// Whether an error of libsdformat is ignored, for one of three reasons. GSV checks the case itself.
// Or GSV accepts the case, such as a sensor of an unknown type, or a script without a <uri>. Or the
// error only summarizes other errors.
bool IsChecked(const sdf::Error& error) {
  const sdf::ErrorCode code = error.Code();
  for (const char* start :
       {"Attempting to load a Sensor", "Failed to load a", "ForceTorque element",
        "A <script> element is missing", "Error reading element <sdf>"}) {
    if (error.Message().rfind(start, 0) == 0) return true;
  }
  return code == sdf::ErrorCode::VERSION_DEPRECATED || code == sdf::ErrorCode::ELEMENT_DEPRECATED ||
         code == sdf::ErrorCode::ATTRIBUTE_DEPRECATED ||
         code == sdf::ErrorCode::LINK_INERTIA_INVALID ||
         code == sdf::ErrorCode::MODEL_WITHOUT_LINK ||
         code == sdf::ErrorCode::STRING_READ;  // this error repeats the whole text
}

void Collect(const sdf::Errors& errors, const std::filesystem::path& source,
             base::Problems& problems) {
  std::set<std::string> told;
  for (const sdf::Error& error : errors) {
    if (IsChecked(error)) continue;
    Problem problem{Problem::Severity::kWarning, Shortened(error.Message()),
                    ErrorPlace(error, source)};
    if (told.insert(problem.Sentence()).second) problems.push_back(std::move(problem));
  }
}

// Returns an error with the reason why nothing could be read.
base::Failure<base::Error> Refusal(const Reading& reading, const std::filesystem::path& source) {
  constexpr auto kBadModel = base::ErrorCode::kBadModel;
  std::string reasons;
  for (const std::string& reason : Reasons().reasons) {
    reasons += (reasons.empty() ? "" : "; ") + Shortened(reason);
  }
  if (!reasons.empty()) {
    return base::Fail(kBadModel, "the robot cannot be read: " + Shortened(reasons),
                      source.string());
  }
  if (!reading.exception.empty()) {
    return base::Fail(kBadModel, "the file cannot be read: " + Shortened(reading.exception),
                      source.string());
  }
  for (const sdf::Error& error : reading.errors) {
    if (IsChecked(error)) continue;
    return base::Fail(kBadModel, Shortened(error.Message()), ErrorPlace(error, source));
  }
  return base::Fail(kBadModel, "the file contains no world or model", source.string());
}

// Reads the document, repairs it, and reads it again until no error can be repaired.
void ReadRepaired(SdfText document, IncludedFiles includes, Reading& reading,
                  base::Problems& problems) GSV_REQUIRES(SdformatMutex()) {
  for (int round = 0; round < kMaxRepairs; ++round) {
    const bool is_repaired = reading.exception.empty()
                                 ? RepairAfter(reading.errors, document, includes, problems)
                                 : SeparateNames(document, includes, problems);
    if (!is_repaired) break;
    reading = ReadOnce(document.text, includes);
  }
}

}  // namespace

base::Mutex& SdformatMutex() {
  static base::Mutex mutex;
  return mutex;
}

void SilenceConsoles() {
  static std::once_flag once;
  std::call_once(once, [] {
    sdf::Console::Instance()->SetQuiet(true);
    console_bridge::useOutputHandler(&Reasons());
  });
}

sdf::ElementPtr SdfSchema() { return DescriptionInFile("root.sdf"); }

namespace {

base::Result<SdfDocument> ParseTexts(const SdfText& document, const IncludedFiles& includes,
                                     base::Problems& problems) {
  const base::MutexLock lock(SdformatMutex());
  SilenceConsoles();
  Reading reading = ReadOnce(document.text, includes);
  if (!reading.errors.empty() || !reading.exception.empty()) {
    ReadRepaired(document, includes, reading, problems);
  }
  if (!reading.HasContent()) return Refusal(reading, document.path);
  Collect(reading.errors, document.path, problems);
  SdfDocument result{std::move(reading.root), document.path, false};
  result.has_broken_frames =
      std::any_of(reading.errors.begin(), reading.errors.end(), BreaksFrames);
  return result;
}

}  // namespace

base::Result<SdfDocument> ParseSdf(const SdfText& document, const IncludedFiles& includes,
                                   base::Problems& problems) {
  if (!MayHaveReservedNames(document, includes)) return ParseTexts(document, includes, problems);
  SdfText separated = document;
  IncludedFiles files = includes;
  SeparateReservedNames(separated, files, problems);
  return ParseTexts(separated, files, problems);
}

std::filesystem::path FileOf(const sdf::Element& element, const std::filesystem::path& source) {
  const std::string& file = element.FilePath();
  return IsNoFile(file) ? source : std::filesystem::path(file);
}

std::string PlaceOf(const sdf::Element& element, const std::filesystem::path& source) {
  std::string line, inner;
  const sdf::Element* known = &element;  // the innermost element whose path libsdformat knows
  sdf::ElementPtr above;
  for (;;) {
    if (line.empty() && known->LineNumber().value_or(0) > 0) {
      line = ":" + std::to_string(*known->LineNumber());
    }
    if (line.empty() && known->HasAttribute(kLineAttribute)) {
      line = ":" + known->GetAttribute(kLineAttribute)->GetAsString();
    }
    if (!known->XmlPath().empty() || known->GetParent() == nullptr) break;
    inner = "/" + known->GetName() + inner;
    above = known->GetParent();
    known = above.get();
  }
  std::string place = FileOf(*known, source).string() + line;
  if (!known->XmlPath().empty()) place += ": " + known->XmlPath() + inner;
  return place;
}

}  // namespace gsv::formats
