#include "apps/gsv/running/browser.h"

#include <linux/close_range.h>
#include <unistd.h>

#include <cstdlib>

namespace gsv::app {

void OpenBrowser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  if (fork() == 0) {
    close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);
    execlp("xdg-open", "xdg-open", url.c_str(), nullptr);
    _exit(127);
  }
}

}  // namespace gsv::app
