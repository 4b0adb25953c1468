#include "apps/gsv/running/browser.h"

#include <unistd.h>

#include <cstdlib>

namespace gsv::app {

void OpenBrowser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  if (fork() == 0) {
    execlp("xdg-open", "xdg-open", url.c_str(), nullptr);
    _exit(127);
  }
}

}  // namespace gsv::app
