#include "gsv/base/log.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/base/log_rate_limiter.h"
#include "gsv/base/log_text.h"

namespace gsv::base {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(LogLine, EscapesControlCharactersToStayOnOneLine) {
  EXPECT_EQ(LogLine("plain: ä € 𝄞", 100, {}), "plain: ä € 𝄞");
  EXPECT_EQ(LogLine("a\nb\tc\rd", 100, {}), "a\\nb\\tc\\rd");
  // These control sequences would colour a terminal, or change its title.
  EXPECT_EQ(LogLine("\x1b[31m\x07", 100, {}), "\\x1b[31m\\x07");
  EXPECT_EQ(LogLine("\xc2\x9b", 100, {}), "\\xc2\\x9b");
  EXPECT_EQ(LogLine(std::string("a\0b", 3), 100, {}), "a\\x00b");
}

TEST(LogLine, EscapesInvalidUtf8) {
  EXPECT_EQ(LogLine("\xff", 100, {}), "\\xff");
  EXPECT_EQ(LogLine("\xc3", 100, {}), "\\xc3");                    // an incomplete UTF-8 sequence
  EXPECT_EQ(LogLine("\xc0\xaf", 100, {}), "\\xc0\\xaf");           // an overlong UTF-8 encoding
  EXPECT_EQ(LogLine("\xed\xa0\x80", 100, {}), "\\xed\\xa0\\x80");  // a UTF-16 surrogate
}

TEST(LogLine, TruncatesLongMessages) {
  EXPECT_EQ(LogLine(std::string(10, 'a'), 10, {}), std::string(10, 'a'));
  EXPECT_EQ(LogLine(std::string(14, 'a'), 10, {}), std::string(10, 'a') + " (and 4 bytes more)");
}

TEST(LogLine, HidesSecrets) {
  const std::vector<std::string> secrets{"hunter2hunter2"};
  EXPECT_EQ(LogLine("token=hunter2hunter2&a=hunter2hunter2", 100, secrets),
            "token=(hidden)&a=(hidden)");
  // If a truncated message ends inside a secret, no part of the secret is shown.
  EXPECT_EQ(LogLine("token=hunter2hunter2", 10, secrets), "token=(hid (and 4 bytes more)");
}

TEST(JsonText, EscapesQuotesAndBackslashes) {
  EXPECT_EQ(JsonText(R"(say "a\b")"), R"("say \"a\\b\"")");
}

TEST(LogRateLimiter, LimitsTheBurstAndTheMeanRate) {
  const LogRateLimiter::Time start{};
  LogRateLimiter budget(2);
  int at_once = 0;
  while (budget.Take(start)) ++at_once;
  EXPECT_EQ(at_once, 100);
  int in_ten_seconds = 0;
  for (int i = 1; i <= 80; ++i) {
    in_ten_seconds += budget.Take(start + i * milliseconds(125)) ? 1 : 0;
  }
  EXPECT_EQ(in_ten_seconds, 20);
  EXPECT_EQ(budget.TakeSuppressed(), 1u + 60u);
  EXPECT_EQ(budget.TakeSuppressed(), 0u);
}

TEST(LogRateLimiter, IgnoresAClockThatIsSetBack) {
  const LogRateLimiter::Time start = LogRateLimiter::Time{} + seconds(1000);
  LogRateLimiter budget(1);
  while (budget.Take(start)) {
  }
  EXPECT_FALSE(budget.Take(start - seconds(900)));
  EXPECT_TRUE(budget.Take(start - seconds(899)));
}

TEST(Log, SuppressesAFloodAndLogsTheNumberOfSuppressedLines) {
  LogOptions options;
  options.level = spdlog::level::info;
  options.lines_per_second = 1;
  const auto before = spdlog::default_logger();
  const LogCounts counts = ProcessLogCounts();
  ::testing::internal::CaptureStderr();
  InitLogging(options);
  for (int i = 0; i < 1000; ++i) spdlog::info("line {}", i);
  spdlog::error("this matters");  // an error is written despite the flood
  spdlog::set_default_logger(before);
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("line 0\n"), std::string::npos);
  EXPECT_EQ(log.find("line 999\n"), std::string::npos);
  EXPECT_NE(log.find("this matters\n"), std::string::npos);
  EXPECT_NE(log.find(" more lines were suppressed"), std::string::npos) << log;
  const LogCounts after = ProcessLogCounts();
  // Every line is counted, either as written or as suppressed. The line that reports suppressed
  // lines is also counted.
  const std::uint64_t lines = static_cast<std::uint64_t>(std::count(log.begin(), log.end(), '\n'));
  EXPECT_EQ(after.written - counts.written, lines);
  EXPECT_GE(after.suppressed - counts.suppressed, 900u);
  EXPECT_GE(lines + after.suppressed - counts.suppressed, 1001u + 1u);
}

TEST(Log, ParsesLevelsAndFormats) {
  EXPECT_EQ(ParseLogLevel("warning").value(), spdlog::level::warn);
  EXPECT_EQ(ParseLogLevel("off").value(), spdlog::level::off);
  EXPECT_NE(ParseLogLevel("loud").error().message.find("trace, debug"), std::string::npos);
  EXPECT_EQ(ParseLogFormat("json").value(), LogFormat::kJson);
  EXPECT_FALSE(ParseLogFormat("xml"));
}

}  // namespace
}  // namespace gsv::base
