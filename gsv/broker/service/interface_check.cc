#include "gsv/broker/service/interface_check.h"

#include <algorithm>

namespace gsv::broker {
namespace {

constexpr unsigned long kAnswerWithinMs = 1000;
constexpr std::string_view kObject = "IDL:omg.org/CORBA/Object:1.0";

bool HasRepositoryPrefix(std::string_view name) { return name.starts_with("IDL:"); }

// Converts "IDL:omg.org/CosTrading/Lookup:1.0" to "omg.org/CosTrading/Lookup".
std::string_view Path(std::string_view id) {
  if (HasRepositoryPrefix(id)) id.remove_prefix(4);
  return id.substr(0, id.rfind(':'));
}

// Converts "::CosTrading::Lookup" to "CosTrading/Lookup".
std::string PathOfScopedName(std::string_view name) {
  if (name.starts_with("::")) name.remove_prefix(2);
  std::string path(name);
  for (std::size_t at = path.find("::"); at != std::string::npos; at = path.find("::", at)) {
    path.replace(at, 2, "/");
  }
  return path;
}

// Whether `path` ends with the parts of `end`: "omg.org/CosTrading/Lookup" ends with
// "CosTrading/Lookup". A scoped name lacks the prefix ("omg.org") of a repository identifier, so
// the two are compared without the prefix.
bool EndsWithPath(std::string_view path, std::string_view end) {
  return path == end || (path.size() > end.size() && path.ends_with(end) &&
                         path[path.size() - end.size() - 1] == '/');
}

}  // namespace

Conformance CompareInterface(std::string_view type_id, std::string_view interface_name) {
  if (interface_name.empty() || interface_name == kObject) return Conformance::kConforms;
  if (type_id.empty()) return Conformance::kUnknown;
  const bool same = HasRepositoryPrefix(interface_name)
                        ? type_id == interface_name
                        : EndsWithPath(Path(type_id), PathOfScopedName(interface_name));
  return same ? Conformance::kConforms : Conformance::kUnknown;
}

Conformance CheckInterface(CORBA::Object_ptr service, std::string_view type_id,
                           const std::string& interface_name) {
  const Conformance compared = CompareInterface(type_id, interface_name);
  if (compared != Conformance::kUnknown) return compared;
  const std::string id = HasRepositoryPrefix(interface_name)
                             ? interface_name
                             : "IDL:" + PathOfScopedName(interface_name) + ":1.0";
  try {
    omniORB::setClientCallTimeout(service, kAnswerWithinMs);
    return service->_is_a(id.c_str()) ? Conformance::kConforms : Conformance::kDiffers;
  } catch (const CORBA::SystemException&) {
    return Conformance::kUnknown;
  }
}

}  // namespace gsv::broker
