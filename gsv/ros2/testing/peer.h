// For tests: another participant of the same domain, which reads and writes raw samples.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/mutex.h"
#include "gsv/messages/cdr.h"
#include "gsv/ros2/dds/module.h"
#include "gsv/ros2/names.h"

namespace gsv::ros2::testing {

inline constexpr std::chrono::seconds kTimeout{20};

// Returns different domains for tests that run at the same time, so that they do not exchange
// messages.
inline std::uint32_t DomainOfProcess() { return 1 + static_cast<std::uint32_t>(getpid()) % 100; }

inline std::unique_ptr<dds::Participant> MakeParticipant(bool watches_endpoints = false) {
  const char* const folder = std::getenv("GSV_BUILD_DIR");
  const auto module = dds::LoadModule({std::string(folder == nullptr ? "." : folder) + "/lib/gsv"});
  EXPECT_TRUE(module) << module.error().Sentence();
  if (!module) return nullptr;
  auto made = (*module)->make({.domain = DomainOfProcess(),
                               .user_data = "enclave=/;",
                               .watches_endpoints = watches_endpoints});
  EXPECT_TRUE(made) << made.error().Sentence();
  return made ? *std::move(made) : nullptr;
}

// A participant that keeps all samples of the topics to which it listens.
class Peer {
 public:
  explicit Peer(bool watches_endpoints = false)
      : participant_(MakeParticipant(watches_endpoints)) {}

  dds::Participant& participant() { return *participant_; }

  // Subscribes to a topic, and stores the messages for Await() and Count().
  void Listen(const std::string& topic, const std::string& type, const dds::Qos& qos) {
    auto reader =
        participant_->MakeReader({DdsTopicName(topic), DdsTypeName(type), qos, {}},
                                 [this, topic](std::span<const std::byte> sample) {
                                   {
                                     const base::MutexLock lock(mutex_);
                                     samples_[topic].emplace_back(sample.begin(), sample.end());
                                   }
                                   changed_.notify_all();
                                 });
    ASSERT_TRUE(reader);
    readers_.push_back(*std::move(reader));
  }

  // Waits for at least `count` messages and returns the newest message. Fails the test if they do
  // not arrive.
  template <typename Message>
  Message Await(const std::string& topic, std::size_t count = 1) {
    base::MutexLock lock(mutex_);
    const bool has_come = changed_.wait_for(
        lock, kTimeout, [&]() GSV_REQUIRES(mutex_) { return samples_[topic].size() >= count; });
    EXPECT_TRUE(has_come) << "nothing on " << topic;
    if (!has_come) return {};
    const auto message = messages::Decode<Message>(samples_[topic].back());
    EXPECT_TRUE(message) << message.error().Sentence();
    return message ? *message : Message{};
  }
  // Returns the number of messages received on a topic.
  std::size_t Count(const std::string& topic) {
    const base::MutexLock lock(mutex_);
    return samples_[topic].size();
  }

  // Returns a writer after it has at least one matched reader.
  std::unique_ptr<dds::Writer> Talk(const std::string& topic, const std::string& type,
                                    const dds::Qos& qos = {}) {
    auto writer =
        participant_->MakeWriter({DdsTopicName(topic), DdsTypeName(type), qos, {}}, [this] {
          const base::MutexLock lock(mutex_);  // so that no waiting thread misses the notification
          changed_.notify_all();
        });
    EXPECT_TRUE(writer);
    base::MutexLock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kTimeout, [&] { return (*writer)->has_readers(); }))
        << topic;
    return *std::move(writer);
  }

 private:
  base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified when a sample or a reader comes
  std::map<std::string, std::vector<messages::Bytes>> samples_ GSV_GUARDED_BY(mutex_);
  std::unique_ptr<dds::Participant> participant_;
  std::vector<std::unique_ptr<dds::Reader>> readers_;
};

}  // namespace gsv::ros2::testing
