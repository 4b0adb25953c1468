#include "gsv/formats/sdf/sdf_document.h"

#include <console_bridge/console.h>
#include <sdf/Console.hh>
#include <sdf/Element.hh>
#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>

#include "gsv/base/mutex.h"

namespace gsv::formats {
namespace {

using base::Problem;

// libsdformat names text that came from no file "<data-string>" or "<urdf-string>", and numbers no
// lines of the latter.
bool IsNoFile(const std::string& file) { return file.empty() || file.front() == '<'; }

void SilenceConsoles() {
  static std::once_flag once;
  std::call_once(once, [] {
    sdf::Console::Instance()->SetQuiet(true);
    console_bridge::noOutputHandler();
  });
}

sdf::ParserConfig ConfigFor(const std::map<std::string, std::filesystem::path>& includes) {
  sdf::ParserConfig config;
  config.SetFindCallback([includes](const std::string& uri) {
    const auto it = includes.find(uri);
    return it == includes.end() ? std::string() : it->second.string();
  });
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  return config;
}

std::string ErrorPlace(const sdf::Error& error, const std::filesystem::path& source) {
  std::string file = error.FilePath().value_or("");
  if (IsNoFile(file)) file = source.string();
  std::string place = file;
  if (error.LineNumber().value_or(0) > 0) place += ":" + std::to_string(*error.LineNumber());
  if (error.XmlPath() && !error.XmlPath()->empty()) place += ": " + *error.XmlPath();
  return place;
}

// What libsdformat complains of but this program lives with or finds out by itself: sensors of
// types that it does not know are welcome.
bool IsChecked(const sdf::Error& error) {
  const sdf::ErrorCode code = error.Code();
  return error.Message().rfind("Attempting to load a Sensor", 0) == 0 ||
         code == sdf::ErrorCode::VERSION_DEPRECATED || code == sdf::ErrorCode::ELEMENT_DEPRECATED ||
         code == sdf::ErrorCode::ATTRIBUTE_DEPRECATED ||
         code == sdf::ErrorCode::LINK_INERTIA_INVALID;
}

void Collect(const sdf::Errors& errors, const std::filesystem::path& source,
             base::Problems& problems) {
  for (const sdf::Error& error : errors) {
    if (IsChecked(error)) continue;
    const bool absent = error.Code() == sdf::ErrorCode::URI_LOOKUP;
    problems.push_back({absent ? Problem::Severity::kWarning : Problem::Severity::kError,
                        error.Message(), ErrorPlace(error, source)});
  }
}

}  // namespace

base::Result<SdfDocument> ParseSdf(const std::string& text, const std::filesystem::path& source,
                                   const std::map<std::string, std::filesystem::path>& includes,
                                   base::Problems& problems) {
  static base::Mutex one_at_a_time;
  const base::MutexLock lock(one_at_a_time);
  SilenceConsoles();
  SdfDocument document{std::make_unique<sdf::Root>(), source};
  sdf::Errors errors;
  try {
    errors = document.root->LoadSdfString(text, ConfigFor(includes));
  } catch (const std::exception& exception) {
    return Fail(base::ErrorCode::kBadModel, exception.what(), source.string());
  }
  Collect(errors, source, problems);
  if (document.root->WorldCount() == 0 && document.root->Model() == nullptr &&
      document.root->Light() == nullptr) {
    if (errors.empty()) {
      return Fail(base::ErrorCode::kBadModel, "there is no world or model inside", source.string());
    }
    return Fail(base::ErrorCode::kBadModel, errors.front().Message(),
                ErrorPlace(errors.front(), source));
  }
  return document;
}

std::filesystem::path FileOf(const sdf::Element& element, const std::filesystem::path& source) {
  const std::string& file = element.FilePath();
  return IsNoFile(file) ? source : std::filesystem::path(file);
}

std::string PlaceOf(const sdf::Element& element, const std::filesystem::path& source) {
  std::string place = FileOf(element, source).string();
  if (element.LineNumber().value_or(0) > 0) place += ":" + std::to_string(*element.LineNumber());
  if (!element.XmlPath().empty()) place += ": " + element.XmlPath();
  return place;
}

}  // namespace gsv::formats
