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
    set.error().message += "; limits of the server: " + ServerLimitNames();
  }
  return set;
}

CLI::Option* AddOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits* server,
                       const std::string& description) {
  return command
      .add_option_function<std::vector<std::string>>(
          "--limit",
          [&limits, server](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              if (const auto set = SetAnyLimit(text, limits, server); !set) {
                throw CLI::ValidationError("--limit", set.error().Sentence());
              }
            }
          },
          description)
      ->type_name("NAME=NUMBER");
}

}  // namespace

CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits) {
  return AddOption(command, limits, nullptr,
                   "limit for files, such as mesh_triangles=20000000\n"
                   "docs/limits.md lists the limits.");
}

CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server) {
  return AddOption(command, limits, &server, "upper limit, such as robots=500; see docs/limits.md");
}

}  // namespace gsv::app
