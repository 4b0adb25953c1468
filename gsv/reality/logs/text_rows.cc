#include "gsv/reality/logs/text_rows.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>

namespace gsv::reality {
namespace {

constexpr std::uintmax_t kMaxBytes = 512u << 20;
constexpr std::size_t kMaxLine = 1u << 20;
constexpr std::size_t kMaxSentences = 20;
constexpr double kLongGap = 10;          // s
constexpr std::size_t kMaxMisdated = 5;  // maximum number of consecutive rows with wrong times

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

base::Result<TextRows> TextRows::Open(const std::filesystem::path& path, base::Problems& problems) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return base::Fail(base::ErrorCode::kNotFound, "no such file", path.string());
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMaxBytes) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      fmt::format("the file has {} bytes; the limit is {} bytes", size, kMaxBytes),
                      path.string());
  }
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.good() && !file.eof()) {
    return base::Fail(base::ErrorCode::kUnavailable, "the file cannot be read", path.string());
  }
  return TextRows(path, std::move(text), problems);
}

bool TextRows::Next() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view whole(text_.data() + at_, end - at_);
    at_ = end + 1;
    ++line_;
    words_.clear();
    if (whole.size() > kMaxLine) {
      ++rows_;
      LeaveOut(fmt::format("the line has {} characters; the limit is {}", whole.size(), kMaxLine));
      continue;
    }
    for (std::size_t i = 0; i < whole.size();) {
      while (i < whole.size() && IsBlank(whole[i])) ++i;
      const std::size_t start = i;
      while (i < whole.size() && !IsBlank(whole[i])) ++i;
      if (i > start) words_.push_back(whole.substr(start, i - start));
    }
    if (words_.empty() || words_.front().starts_with('#')) continue;
    ++rows_;
    return true;
  }
  return false;
}

bool TextRows::Numbers(std::size_t first, std::size_t count, std::vector<double>& numbers) {
  numbers.clear();
  if (words_.size() < first + count) {
    LeaveOut(fmt::format("the row has {} fields and needs {}; it may be cut off", words_.size(),
                         first + count));
    return false;
  }
  numbers.reserve(count);
  for (std::size_t i = first; i < first + count; ++i) {
    const std::string_view word = words_[i];
    double value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || rest != word.data() + word.size() || !std::isfinite(value)) {
      LeaveOut(
          fmt::format("field {} is \"{}\"; it must be a finite number", i + 1, word.substr(0, 40)));
      return false;
    }
    numbers.push_back(value);
  }
  return true;
}

bool TextRows::InOrder(double time) {
  if (doubtful_) DecideOn(time);
  if (!recent_.empty() && time < recent_.back().time) {
    const auto ahead = static_cast<std::size_t>(std::count_if(
        recent_.begin(), recent_.end(), [&](const TimedLine& row) { return row.time > time; }));
    if (ahead <= kMaxMisdated) {
      doubtful_ = TimedLine{time, line_};
      return true;
    }
    LeaveOut(fmt::format("time goes back from {} to {} s", recent_.back().time, time));
    return false;
  }
  // A gap is reported only when all rows in recent_ are after it. Until then, a row may still show
  // that the rows after the gap have wrong times, and that there is no gap.
  if (gap_ && recent_.front().time >= gap_->second.time) ReportGap();
  if (!recent_.empty() && time - recent_.back().time > kLongGap) {
    ReportGap();
    gap_ = {recent_.back().time, {time, line_}};
  }
  recent_.push_back({time, line_});
  if (recent_.size() > kMaxMisdated + 1) recent_.erase(recent_.begin());
  return true;
}

// Decides whether the doubtful row is wrong. `time` is the time of the row after it, or infinite at
// the end of the file.
void TextRows::DecideOn(double time) {
  const TimedLine row = *std::exchange(doubtful_, std::nullopt);
  const double last = recent_.back().time;
  if (time >= last || time < row.time) {
    return LeaveOutAsMisdated(row, fmt::format("time goes back from {} to {} s", last, row.time));
  }
  while (!recent_.empty() && recent_.back().time > row.time) {
    const TimedLine wrong = recent_.back();
    recent_.pop_back();
    LeaveOutAsMisdated(wrong,
                       fmt::format("its time, {} s, is later than the time of a row after it, {} s",
                                   wrong.time, row.time));
  }
  if (gap_ && gap_->second.time > row.time) gap_.reset();
  recent_.push_back(row);
}

void TextRows::ReportGap() {
  if (!gap_) return;
  WarnOf(fmt::format("the clock jumps from {} to {} s; nothing is compared across the gap",
                     gap_->first, gap_->second.time),
         gap_->second.line);
  gap_.reset();
}

void TextRows::LeaveOutAsMisdated(const TimedLine& row, const std::string& why) {
  misdated_.push_back(row.time);
  LeaveOutLine(why, row.line);
}

void TextRows::LeaveOutLine(const std::string& why, int line) {
  ++left_out_;
  WarnOf(why + "; the row is ignored", line);
}

void TextRows::Warn(const std::string& what) { WarnOf(what, line_); }

void TextRows::WarnOf(const std::string& what, int line) {
  if (++warnings_ > kMaxSentences) return;
  problems_->push_back(
      {base::Problem::Severity::kWarning, what, fmt::format("{}:{}", path_.string(), line)});
}

base::Status TextRows::Finish(std::size_t used) {
  if (doubtful_) DecideOn(std::numeric_limits<double>::infinity());
  ReportGap();
  if (warnings_ > kMaxSentences) {
    problems_->push_back({base::Problem::Severity::kWarning,
                          fmt::format("{} more rows have problems", warnings_ - kMaxSentences),
                          path_.string()});
  }
  if (used == 0) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "no row can be used; is the format (--as) the right one?", path_.string());
  }
  if (left_out_ * 10 > rows_) {
    return base::Fail(
        base::ErrorCode::kCorrupt,
        fmt::format("{} of {} rows cannot be used, which is too many to trust the rest", left_out_,
                    rows_),
        path_.string());
  }
  return {};
}

}  // namespace gsv::reality
