#include "apps/gsv/viewer_options.h"

#include <CLI/CLI.hpp>

namespace gsv::app {

void AddViewerOptions(CLI::App& command, ViewerOptions& options) {
  command
      .add_option("--port", options.port,
                  "the viewer's port; 0: any that is free (default: 8080, or any)")
      ->check(CLI::Range(0, 65535));
}

void AddRecordingsOption(CLI::App& command, ViewerOptions& options) {
  command.add_option("--recordings", options.recordings,
                     "the folder whose recordings the viewer lists, and to which it records; "
                     "without it: the current one");
}

}  // namespace gsv::app
