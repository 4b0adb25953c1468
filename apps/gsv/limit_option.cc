#include "apps/gsv/limit_option.h"

#include <CLI/CLI.hpp>

namespace gsv::app {

void AddLimitOption(CLI::App& command, formats::ReadLimits& limits) {
  command.add_option_function<std::vector<std::string>>(
      "--limit",
      [&limits](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          if (const auto set = formats::SetLimit(text, limits); !set) {
            throw CLI::ValidationError("--limit", set.error().Sentence());
          }
        }
      },
      "NAME=NUMBER: what files may ask for at most, such as mesh_triangles=20000000");
}

}  // namespace gsv::app
