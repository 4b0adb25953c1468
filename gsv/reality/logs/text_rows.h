// The rows of a text log: words separated by blanks, one row per line.
//
// Input   untrusted. A file above 512 MiB is refused. An unusable row, such as a line above 1 MiB,
//         is left out with a sentence that names file and line. For each file, the first 20 such
//         sentences are kept, and the others are counted. If more than a tenth of the rows is
//         unusable, the file is refused.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::reality {

class TextRows {
 public:
  // Fails with kNotFound, kCorrupt or kUnavailable. `problems` must outlive this object.
  static base::Result<TextRows> Open(const std::filesystem::path& path, base::Problems& problems);

  // Moves to the next row. Skips blank lines and comments (#).
  bool Next();
  std::size_t size() const { return words_.size(); }
  std::string_view word(std::size_t i) const { return words_[i]; }
  int line() const { return line_; }
  const std::filesystem::path& path() const { return path_; }

  // Reads the words from index `first` on as numbers. Returns false and adds a problem if there are
  // fewer than `count` words, or if a word is not a finite number.
  bool Numbers(std::size_t first, std::size_t count, std::vector<double>& numbers);

  // Returns whether the caller may use this row, whose time is `time`. Times must not decrease. If
  // this row is earlier than some rows before it, either these rows or this row have wrong times:
  // - If this row is earlier than more than five rows, it is left out, and the result is false.
  // - Else the result is true, and the next call of InOrder() decides. If the next row is also
  //   earlier than the latest row, but not earlier than this row, the rows before this row are
  //   wrong. Else this row is wrong.
  // At that time, the caller has already used the rows with wrong times. RemoveMisdated() removes
  // their values. Reports a gap of more than 10 s.
  bool InOrder(double time);

  // Removes from `series` the elements that the caller made from rows with wrong times. The
  // elements must have a member `time`. Call this after Finish().
  template <typename Series>
  void RemoveMisdated(Series& series) const {
    if (misdated_.empty()) return;
    std::erase_if(series, [&](const auto& of) {
      return std::find(misdated_.begin(), misdated_.end(), of.time) != misdated_.end();
    });
  }

  // Counts the current row as unusable, and reports the reason.
  void LeaveOut(const std::string& why) { LeaveOutLine(why, line_); }
  // Reports a problem of the current row, which stays usable.
  void Warn(const std::string& what);

  // Call this after the last row. Fails with kCorrupt if too many rows were left out, or if no row
  // was used.
  base::Status Finish(std::size_t used);

 private:
  TextRows(std::filesystem::path path, std::string text, base::Problems& problems)
      : path_(std::move(path)), text_(std::move(text)), problems_(&problems) {}
  // The time of a row, and the row's line in the file.
  struct TimedLine {
    double time = 0;
    int line = 0;
  };
  // Do the same as LeaveOut() and Warn(), for any line.
  void LeaveOutLine(const std::string& why, int line);
  void WarnOf(const std::string& what, int line);
  // Warns of gap_, and clears it.
  void ReportGap();
  // Leaves out a row that the caller has already used, because its time is wrong.
  void LeaveOutAsMisdated(const TimedLine& row, const std::string& why);
  // Decides whether the time of doubtful_ is wrong. `time` is the time of the row after it.
  void DecideOn(double time);

  std::filesystem::path path_;
  std::string text_;
  base::Problems* problems_;
  std::size_t at_ = 0;  // offset of the next line in text_
  int line_ = 0;
  std::vector<std::string_view> words_;                 // the words of the current row
  std::size_t rows_ = 0, left_out_ = 0, warnings_ = 0;  // numbers of rows and of warnings so far
  // The accepted rows with the latest times, in ascending order, at most kMaxMisdated + 1.
  std::vector<TimedLine> recent_;
  // A row that is earlier than up to five rows before it. The next row shows which of them have
  // wrong times.
  std::optional<TimedLine> doubtful_;
  // The time before a gap, and the row after it. Kept until enough rows confirm the gap.
  std::optional<std::pair<double, TimedLine>> gap_;
  // The times of rows for which InOrder() returned true, and whose times turned out to be wrong.
  std::vector<double> misdated_;
};

}  // namespace gsv::reality
