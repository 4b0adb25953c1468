#include "apps/gsv/serving/limit_option.h"

#include <CLI/CLI.hpp>

namespace gsv::app {
namespace {

base::Status SetAnyLimit(const std::string& text, formats::ReadLimits& limits,
                         ServerLimits* server) {
  const std::string name = text.substr(0, text.find('='));
  if (server != nullptr && IsServerLimit(name)) return SetServerLimit(text, *server);
  auto set = formats::SetLimit(text, limits);
  if (!set && server != nullptr) {
    set.error().message += "; of the server: " + ServerLimitNames();
  }
  return set;
}

void AddOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits* server,
               const std::string& description) {
  command.add_option_function<std::vector<std::string>>(
      "--limit",
      [&limits, server](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          if (const auto set = SetAnyLimit(text, limits, server); !set) {
            throw CLI::ValidationError("--limit", set.error().Sentence());
          }
        }
      },
      description);
}

}  // namespace

void AddLimitOption(CLI::App& command, formats::ReadLimits& limits) {
  AddOption(command, limits, nullptr,
            "NAME=NUMBER: what files may ask for at most, such as mesh_triangles=20000000");
}

void AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server) {
  AddOption(command, limits, &server,
            "NAME=NUMBER: what there may be at most, such as robots=500 or "
            "mesh_triangles=20000000; docs/limits.md lists them");
}

}  // namespace gsv::app
