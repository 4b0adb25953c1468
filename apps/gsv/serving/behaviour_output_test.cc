#include "apps/gsv/serving/behaviour_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/gsv/machine/child_process.h"

namespace gsv::app {
namespace {

using ::testing::Contains;

TEST(LastError, NamesTheInnermostFrameOfAPythonException) {
  EXPECT_EQ(LastError({"warming up", "Traceback (most recent call last):",
                       "  File \"/home/me/wander.py\", line 40, in <module>", "    run()",
                       "  File \"/home/me/wander.py\", line 12, in run", "    raise ValueError(1)",
                       "ValueError: too far"}),
            "ValueError: too far in wander.py line 12");
}

TEST(LastError, IsTheLastLineIfThereIsNoException) {
  EXPECT_EQ(LastError({"one", "two", ""}), "two");
  EXPECT_EQ(LastError({}), "");
  EXPECT_EQ(LastError({"Traceback (most recent call last):", "  File \"x.py\"", "KeyError: 1",
                       "restarting"}),
            "restarting");
}

// Collects the output of a shell until it has ended.
class ReadChild {
 public:
  explicit ReadChild(const std::string& script) {
    auto child = ChildProcess::StartCaptured({"/bin/sh", "-c", script}, {"WORD=given"});
    EXPECT_TRUE(child);
    child_ = *std::move(child);
    reader_ = std::make_unique<OutputReader>(OutputReader::Callbacks{
        [this](pid_t, OutputReader::Stream stream, const std::string& line) {
          const base::MutexLock lock(mutex_);
          lines_.push_back((stream == OutputReader::Stream::kErrors ? "err: " : "out: ") + line);
        },
        [this](pid_t, const std::string& ending) {
          const base::MutexLock lock(mutex_);
          ending_ = ending;
          ended_.notify_all();
        },
        [] {}});
    reader_->AddErrors(*child_);
    reader_->AddOutput(*child_);
    base::MutexLock lock(mutex_);
    ended_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return !ending_.empty(); });
  }
  std::vector<std::string> lines() {
    const base::MutexLock lock(mutex_);
    return lines_;
  }
  std::string ending() {
    const base::MutexLock lock(mutex_);
    return ending_;
  }

 private:
  std::unique_ptr<ChildProcess> child_;
  base::Mutex mutex_;
  base::ConditionVariable ended_;
  std::vector<std::string> lines_ GSV_GUARDED_BY(mutex_);
  std::string ending_ GSV_GUARDED_BY(mutex_);
  std::unique_ptr<OutputReader> reader_;
};

TEST(OutputReader, ReadsBothStreamsLineByLineToTheEnd) {
  ReadChild child("echo $WORD; echo wrong >&2; printf 'no newline'; exit 3");
  EXPECT_EQ(child.ending(), "exit code 3");
  EXPECT_THAT(child.lines(), Contains("out: given"));
  EXPECT_THAT(child.lines(), Contains("err: wrong"));
  EXPECT_THAT(child.lines(), Contains("out: no newline"));
}

TEST(OutputReader, ReadsMoreThanAPipeHolds) {
  ReadChild child(
      "i=0; while [ $i -lt 3000 ]; do echo 0123456789012345678901234567890123456789; "
      "i=$((i+1)); done; kill -9 $$");
  EXPECT_EQ(child.ending(), "signal 9");
  EXPECT_EQ(child.lines().size(), 3000u);
}

}  // namespace
}  // namespace gsv::app
