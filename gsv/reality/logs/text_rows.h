// The rows of a text log: words separated by blanks, one row a line.
//
// Input   untrusted. A file above 512 MiB and a line above 1 MiB are refused. A row that cannot be
//         used is left out with a sentence that names file and line; of one file the first 20 such
//         sentences are kept and the others counted. A file in which every tenth row cannot be used
//         is refused.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::reality {

class TextRows {
 public:
  // Fails with kNotFound or kCorrupt. `problems` must outlive this object.
  static base::Result<TextRows> Open(const std::filesystem::path& path, base::Problems& problems);

  // Moves to the next row; blank lines and those that begin with # are skipped.
  bool Next();
  std::size_t size() const { return words_.size(); }
  std::string_view word(std::size_t i) const { return words_[i]; }
  int line() const { return line_; }

  // Reads the words from `first` on as numbers. If there are fewer than `count`, or one is not a
  // finite number, returns false and adds a problem.
  bool Numbers(std::size_t first, std::size_t count, std::vector<double>& numbers);

  // Whether the time of this row may follow that of the row before it. A row that goes back in time
  // is left out; a gap of more than 10 s is reported.
  bool InOrder(double time);

  void LeaveOut(const std::string& why);
  void Warn(const std::string& what);

  // After the last row: kCorrupt if too many rows were left out, or none was used.
  base::Status Finish(std::size_t used);

 private:
  TextRows(std::filesystem::path path, std::string text, base::Problems& problems)
      : path_(std::move(path)), text_(std::move(text)), problems_(&problems) {}
  std::string Here() const;

  std::filesystem::path path_;
  std::string text_;
  base::Problems* problems_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
  std::size_t rows_ = 0, left_out_ = 0, warnings_ = 0;
  bool has_time_ = false;
  double last_time_ = 0;
};

}  // namespace gsv::reality
