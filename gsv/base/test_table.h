// Writes the measurements of a test for tools/plot_fidelity. It appends rows to NAME.dat in the
// folder that the variable GSV_FIDELITY_DATA names, and does nothing if that variable is not set.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

namespace gsv::base::testing {

// A file of measurements; each call of Row() appends a line.
class Table {
 public:
  explicit Table(const std::string& name) {
    if (const char* folder = std::getenv("GSV_FIDELITY_DATA")) {
      file_.open(folder + ("/" + name + ".dat"), std::ios::app);
    }
  }
  // Appends a line with these values.
  void Row(const std::vector<double>& values) {
    if (!file_.is_open()) return;
    for (const double value : values) file_ << std::setprecision(12) << value << ' ';
    file_ << '\n';
  }

 private:
  std::ofstream file_;
};

}  // namespace gsv::base::testing
