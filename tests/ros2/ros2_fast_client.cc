// A client of get_entity_state that follows rmw_fastrtps. A request names the reader that waits for
// the reply, and a reply names its request, both in the related sample identity.
//
//   ros2_fast_client PLUGIN_FOLDER ENTITY COUNT WINDOW [SECONDS]
//
// Sends COUNT calls, with at most WINDOW calls in progress at a time, and prints the number of
// replies that match their requests. Exits with 0 if all replies came within SECONDS (default:
// 60).
// ROS_DOMAIN_ID selects the domain.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "gsv/base/mutex.h"
#include "gsv/messages/simulation_interfaces.h"
#include "gsv/ros2/dds/module.h"
#include "gsv/ros2/options.h"
#include "gsv/ros2/types/service_names.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::GetEntityStateRequest;
using messages::simulation_interfaces::GetEntityStateResponse;

constexpr const char* kService = "/gsv/get_entity_state";
constexpr const char* kType = "simulation_interfaces/srv/GetEntityState";
// The history is long, because the reader also gets the replies to all other clients.
constexpr dds::Qos kQos{.depth = 20'000, .heartbeat_ms = 20};
constexpr int kPatience = 60;  // s

[[noreturn]] void Die(const std::string& why) {
  std::fprintf(stderr, "ros2_fast_client: %s\n", why.c_str());
  std::exit(2);
}

class FastClient {
 public:
  explicit FastClient(dds::Participant& participant) {
    const ServiceTopic request = RequestTopic(kService, kType),
                       reply = ResponseTopic(kService, kType);
    auto reader =
        participant.MakeRequestReader({reply.name, reply.type, kQos, {}},
                                      [this](std::span<const std::byte> sample,
                                             const dds::Request& info) { Take(sample, info); });
    auto writer = participant.MakeWriter({request.name, request.type, kQos, {}}, {});
    if (!reader || !writer) Die("no endpoints");
    reader_ = *std::move(reader);
    writer_ = *std::move(writer);
  }

  int Call(const std::string& entity, int count, int window, std::chrono::seconds patience) {
    messages::Bytes bytes;
    messages::Encode(GetEntityStateRequest{entity}, bytes);
    const auto until = std::chrono::steady_clock::now() + patience;
    base::MutexLock lock(mutex_);
    while (!writer_->has_readers() || reader_->writers() == 0) {
      if (changed_.wait_for(lock, std::chrono::milliseconds(5),
                            [&] { return std::chrono::steady_clock::now() > until; })) {
        Die("the service was not found");
      }
    }
    for (int sent = 0; static_cast<int>(replies_.size()) < count;) {
      while (sent < count && sent - static_cast<int>(replies_.size()) < window) {
        ++sent;
        lock.unlock();
        writer_->WriteReply(bytes, {reader_->guid(), 0});
        lock.lock();
      }
      const auto continues = [&]() GSV_REQUIRES(mutex_) {
        const int replies = static_cast<int>(replies_.size());
        return replies == count || (sent < count && sent - replies < window);
      };
      if (!changed_.wait_until(lock, until, continues)) break;
    }
    return static_cast<int>(replies_.size());
  }

 private:
  void Take(std::span<const std::byte> sample, const dds::Request& info) {
    if (info.related.writer != reader_->guid()) return;  // another client's
    const auto response = messages::Decode<GetEntityStateResponse>(sample);
    if (!response || response->result.result != 1) return;
    {
      const base::MutexLock lock(mutex_);
      replies_.insert(info.related.sequence);
    }
    changed_.notify_all();
  }

  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::set<std::int64_t> replies_ GSV_GUARDED_BY(mutex_);
  std::unique_ptr<dds::Writer> writer_;
  std::unique_ptr<dds::Reader> reader_;
};

int Main(int argc, char** argv) {
  if (argc != 5 && argc != 6) Die("expected PLUGIN_FOLDER ENTITY COUNT WINDOW [SECONDS]");
  const auto options = ParticipantFor({}, ProcessEnvironment);
  const auto module = dds::LoadModule({argv[1]});
  if (!options || !module) Die("no DDS");
  auto participant = (*module)->make(*options);
  if (!participant) Die(participant.error().Sentence());
  const int count = std::atoi(argv[3]);
  const std::chrono::seconds patience(argc == 6 ? std::atoi(argv[5]) : kPatience);
  const int replies = FastClient(**participant).Call(argv[2], count, std::atoi(argv[4]), patience);
  std::printf("{\"calls\": %d, \"replies\": %d}\n", count, replies);
  return replies == count ? 0 : 1;
}

}  // namespace
}  // namespace gsv::ros2

int main(int argc, char** argv) { return gsv::ros2::Main(argc, argv); }
