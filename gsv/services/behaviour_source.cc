#include "gsv/services/behaviour_source.h"

namespace gsv::services {

std::string ConstraintForName(const std::string& name) {
  std::string escaped;
  for (const char c : name) {
    if (c == '\'' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return "name == '" + escaped + "'";
}

}  // namespace gsv::services
