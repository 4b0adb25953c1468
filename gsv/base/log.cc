#include "gsv/base/log.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "gsv/base/log_rate_limiter.h"
#include "gsv/base/log_text.h"
#include "gsv/base/mutex.h"

namespace gsv::base {
namespace {

constexpr std::chrono::seconds kReportPeriod{1};

struct Shared {
  Mutex mutex;
  std::vector<std::string> secrets GSV_GUARDED_BY(mutex);
  std::atomic<std::uint64_t> written{0}, suppressed{0};
};

// The object is never destroyed, so that log calls work until the process ends.
Shared& TheLog() {
  static Shared* const log = new Shared;
  return *log;
}

std::vector<std::string> Secrets() {
  const MutexLock lock(TheLog().mutex);
  return TheLog().secrets;
}

// "2024-05-06T12:03:04.567Z"
std::string TimeText(spdlog::log_clock::time_point time) {
  using std::chrono::duration_cast, std::chrono::milliseconds;
  const auto since = duration_cast<milliseconds>(time.time_since_epoch()).count();
  const auto seconds = static_cast<std::time_t>(since / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", utc.tm_year + 1900,
                     utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                     since % 1000);
}

std::string JsonLine(const spdlog::details::log_msg& message, std::string_view line) {
  const spdlog::string_view_t level = spdlog::level::to_string_view(message.level);
  return fmt::format(R"({{"time":"{}","level":"{}","message":{},"pid":{},"thread":{}}})",
                     TimeText(message.time), fmt::string_view(level.data(), level.size()),
                     JsonText(line), getpid(), message.thread_id);
}

class BoundedSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  BoundedSink(std::shared_ptr<spdlog::sinks::sink> out, const LogOptions& options)
      : out_(std::move(out)), options_(options) {}

  ~BoundedSink() override { LogSuppressed(spdlog::log_clock::time_point::max()); }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    // Errors have a rate limit of their own, so that other lines never suppress an error.
    const bool is_error = message.level >= spdlog::level::err;
    LogRateLimiter& budget = is_error ? errors_ : others_;
    if (!budget.Take(message.time.time_since_epoch())) {
      ++TheLog().suppressed;
      return;
    }
    LogSuppressed(message.time);
    Write(message, LogLine({message.payload.data(), message.payload.size()}, options_.line_bytes,
                           Secrets()));
  }

  // Logs the number of suppressed lines as a separate warning, which the rate limit never
  // suppresses.
  void LogSuppressed(spdlog::log_clock::time_point time) {
    if (time < next_report_) return;
    const std::uint64_t lines = errors_.TakeSuppressed() + others_.TakeSuppressed();
    if (lines == 0) return;
    const auto now = spdlog::log_clock::now();
    next_report_ = now + kReportPeriod;
    const std::string text =
        fmt::format("{} more lines were suppressed: too many came at once", lines);
    Write({now, {}, "gsv", spdlog::level::warn, text}, text);
  }

  void Write(spdlog::details::log_msg message, std::string line) {
    if (options_.format == LogFormat::kJson) line = JsonLine(message, line);
    message.payload = line;
    out_->log(message);
    ++TheLog().written;
  }

  void flush_() override { out_->flush(); }
  void set_pattern_(const std::string& pattern) override { out_->set_pattern(pattern); }
  void set_formatter_(std::unique_ptr<spdlog::formatter> formatter) override {
    out_->set_formatter(std::move(formatter));
  }

  const std::shared_ptr<spdlog::sinks::sink> out_;
  const LogOptions options_;
  spdlog::log_clock::time_point next_report_{};
  LogRateLimiter errors_{options_.lines_per_second}, others_{options_.lines_per_second};
};

}  // namespace

Result<spdlog::level::level_enum> ParseLogLevel(const std::string& text) {
  for (const auto level : {spdlog::level::trace, spdlog::level::debug, spdlog::level::info,
                           spdlog::level::warn, spdlog::level::err, spdlog::level::off}) {
    const spdlog::string_view_t name = spdlog::level::to_string_view(level);
    if (text == std::string_view(name.data(), name.size())) return level;
  }
  return Fail(ErrorCode::kInvalidArgument,
              "the log level must be trace, debug, info, warning, error or off");
}

Result<LogFormat> ParseLogFormat(const std::string& text) {
  if (text == "text") return LogFormat::kText;
  if (text == "json") return LogFormat::kJson;
  return Fail(ErrorCode::kInvalidArgument, "the log format must be text or json");
}

LogOptions LogOptionsFromEnvironment(spdlog::level::level_enum level) {
  LogOptions options;
  options.level = level;
  if (const char* text = std::getenv("GSV_LOG_LEVEL")) {
    options.level = ParseLogLevel(text).value_or(level);
  }
  if (const char* text = std::getenv("GSV_LOG_FORMAT")) {
    options.format = ParseLogFormat(text).value_or(LogFormat::kText);
  }
  return options;
}

void InitLogging(const LogOptions& options) {
  std::shared_ptr<spdlog::sinks::sink> out;
  if (options.format == LogFormat::kJson) {
    out = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    out->set_pattern("%v");
  } else {
    out = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    out->set_pattern("%H:%M:%S.%e %^%l%$: %v");
  }
  auto logger = std::make_shared<spdlog::logger>(
      "gsv", std::make_shared<BoundedSink>(std::move(out), options));
  logger->set_level(options.level);
  logger->flush_on(spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

void RedactInLog(const std::string& secret) {
  if (secret.empty()) return;
  const MutexLock lock(TheLog().mutex);
  TheLog().secrets.push_back(secret);
}

LogCounts ProcessLogCounts() { return {TheLog().written, TheLog().suppressed}; }

}  // namespace gsv::base
