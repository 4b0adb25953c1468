// What a test measures, as a table for tools/plot_fidelity: the file NAME.dat in the folder that
// the environment names in GSV_FIDELITY_DATA. Without it, nothing.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

namespace gsv::dynamics::testing {

class Table {
 public:
  explicit Table(const std::string& name) {
    if (const char* folder = std::getenv("GSV_FIDELITY_DATA")) {
      file_.open(folder + ("/" + name + ".dat"));
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

}  // namespace gsv::dynamics::testing
