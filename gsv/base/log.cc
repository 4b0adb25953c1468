#include "gsv/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>

namespace gsv::base {

void InitLogging(spdlog::level::level_enum level) {
  auto logger = std::make_shared<spdlog::logger>(
      "gsv", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%H:%M:%S.%e %^%l%$: %v");
  logger->set_level(level);
  logger->flush_on(spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace gsv::base
