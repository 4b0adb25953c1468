// For tests: a participant without a DDS library. The test plays the role of the other
// participants.
//
// Threads  AwaitReply() and `knows_clients` on any; everything else on the thread of the test.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/mutex.h"
#include "gsv/messages/cdr.h"
#include "gsv/ros2/dds/participant.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::ros2::testing {

// Endpoints with the vendors of Fast DDS and Cyclone DDS.
inline constexpr dds::Guid kFastClient{0x01, 0x0f, 1}, kCycloneClient{0x01, 0x10, 2};

struct Reply {
  messages::Bytes sample;
  dds::SampleIdentity request;
};

// A participant whose messages the test reads and writes. All clients count as discovered while
// `knows_clients` is true.
class FakeParticipant final : public dds::Participant {
 public:
  using OnRequest = std::function<void(std::span<const std::byte>, const dds::Request&)>;

  base::Result<std::unique_ptr<dds::Writer>> MakeWriter(const dds::Topic& topic,
                                                        std::function<void()>) override {
    topics.push_back(topic);
    return std::make_unique<FakeWriter>(*this);
  }
  base::Result<std::unique_ptr<dds::Reader>> MakeReader(
      const dds::Topic&, std::function<void(std::span<const std::byte>)>) override {
    return std::make_unique<FakeReader>();
  }
  base::Result<std::unique_ptr<dds::Reader>> MakeRequestReader(const dds::Topic& topic,
                                                               OnRequest handler) override {
    topics.push_back(topic);
    on_request = std::move(handler);
    if (on_reader) on_reader(topic);
    return std::make_unique<FakeReader>();
  }
  dds::Guid guid() const override { return {}; }
  std::vector<dds::Endpoint> endpoints() const override { return {}; }

  Reply AwaitReply() {
    base::MutexLock lock(mutex_);
    EXPECT_TRUE(came_.wait_for(lock, simulation::kTimeout,
                               [this]() GSV_REQUIRES(mutex_) { return !replies_.empty(); }));
    if (replies_.empty()) return {};
    Reply reply = std::move(replies_.front());
    replies_.erase(replies_.begin());
    return reply;
  }
  void Discover() { knows_clients = true; }

  std::vector<dds::Topic> topics;
  OnRequest on_request;  // callback of the newest reader of requests
  // Called as soon as a client could send a request; may be empty.
  std::function<void(const dds::Topic&)> on_reader;
  std::atomic<bool> knows_clients{true};

 private:
  class FakeWriter final : public dds::Writer {
   public:
    explicit FakeWriter(FakeParticipant& participant) : participant_(participant) {}
    void WriteParts(std::span<const std::byte>, std::span<const std::byte>) override {}
    void WriteReply(std::span<const std::byte> sample,
                    const dds::SampleIdentity& request) override {
      const base::MutexLock lock(participant_.mutex_);
      participant_.replies_.push_back({{sample.begin(), sample.end()}, request});
      participant_.came_.notify_all();
    }
    bool HasReaderInSameParticipant(const dds::Guid&) const override {
      return participant_.knows_clients;
    }
    bool has_readers() const override { return true; }
    dds::Guid guid() const override { return {1}; }

   private:
    FakeParticipant& participant_;
  };
  class FakeReader final : public dds::Reader {
   public:
    dds::Guid guid() const override { return {2}; }
    int writers() const override { return 0; }
  };

  base::Mutex mutex_;
  base::ConditionVariable came_;  // notified when a reply comes
  std::vector<Reply> replies_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::ros2::testing
