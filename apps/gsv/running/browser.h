// Opens pages in the user's browser.
#pragma once

#include <string>

namespace gsv::app {

// Does nothing without a graphical session.
void OpenBrowser(const std::string& url);

}  // namespace gsv::app
