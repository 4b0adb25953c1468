// Writes the measurements of a test for tools/plot_fidelity: appends rows to NAME.dat in the folder
// GSV_FIDELITY_DATA. Does nothing if that variable is not set.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

namespace gsv::base::testing {

class Table {
 public:
  explicit Table(const std::string& name) {
    if (const char* folder = std::getenv("GSV_FIDELITY_DATA")) {
      file_.open(folder + ("/" + name + ".dat"), std::ios::app);
    }
  }
  void Row(const std::vector<double>& values) {
    if (!file_.is_open()) return;
    for (const double value : values) file_ << std::setprecision(12) << value << ' ';
    file_ << '\n';
  }

 private:
  std::ofstream file_;
};

}  // namespace gsv::base::testing
