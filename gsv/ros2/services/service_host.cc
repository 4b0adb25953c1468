#include "gsv/ros2/services/service_host.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <set>
#include <thread>

#include "gsv/base/log.h"
#include "gsv/ros2/types/service_names.h"
#include "gsv/ros2/types/type_hash.h"

namespace gsv::ros2 {
namespace {

using WallClock = std::chrono::steady_clock;

constexpr std::size_t kMaxWaiting = 10'000;   // requests
constexpr std::size_t kMaxRequest = 1 << 20;  // bytes
// Maximum number of replies to clients that are not yet discovered.
constexpr std::size_t kMaxUnsent = 1000;
// Maximum time for which a reply waits for its client. Discovery may take this long if a busy
// machine loses a datagram. The datagram is then sent again after a heartbeat, whose usual period
// is 3 s.
constexpr std::chrono::milliseconds kDiscovery{10'000};
constexpr std::chrono::milliseconds kRetry{10};

constexpr std::size_t kEncapsulation = 4;
constexpr std::size_t kCycloneHeader = 16;

// `depth` is the number of replies that are kept, so that they can be sent again. It is large
// because some clients send many requests without waiting for replies, or do not run for some
// seconds. If a client's socket had no space for a reply, the reply is sent again after the next
// heartbeat.
constexpr dds::Qos kServiceQos{.depth = 20'000, .heartbeat_ms = 20};
// If replies may be large, fewer replies are kept, to limit the memory.
constexpr dds::Qos kListQos{.depth = 200, .heartbeat_ms = 20};

std::vector<std::byte> Joined(std::span<const std::byte> head, std::span<const std::byte> middle,
                              std::span<const std::byte> tail) {
  std::vector<std::byte> joined(head.begin(), head.end());
  joined.insert(joined.end(), middle.begin(), middle.end());
  joined.insert(joined.end(), tail.begin(), tail.end());
  return joined;
}

}  // namespace

bool HasCycloneHeader(const dds::Request& request) {
  const dds::Guid& writer = request.writer;
  // DDS Security replaces a GUID by a hash, and sets its first bit (DDS Security 1.1, 9.3.3).
  const bool is_hashed = (writer[0] & 0x80) != 0;
  if (is_hashed) return request.related.writer == dds::Guid{};
  return writer[0] == 0x01 && writer[1] == 0x10;
}

class ServiceHost::Service {
 public:
  std::string name;
  Handler handler;
  std::unique_ptr<dds::Writer> writer;
  std::weak_ptr<Outbox> outbox;
  base::Mutex writing;  // locked while a reply is written
};

// Keeps replies to clients that are not yet discovered, and sends them after discovery.
class ServiceHost::Outbox {
 public:
  Outbox() : thread_([this] { Run(); }) {}
  ~Outbox() { Stop(); }

  void Send(const std::shared_ptr<Service>& service, std::vector<std::byte> reply,
            const dds::Request& request) {
    if (service->writer->HasReaderInSameParticipant(request.writer)) {
      return Write(*service, reply, request);
    }
    {
      const base::MutexLock lock(mutex_);
      if (is_stopping_ || unsent_.size() >= kMaxUnsent) return;
      unsent_.push_back({service, std::move(reply), request, WallClock::now() + kDiscovery});
    }
    changed_.notify_one();
  }
  void Stop() {
    {
      const base::MutexLock lock(mutex_);
      is_stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

 private:
  struct Unsent {
    std::shared_ptr<Service> service;
    std::vector<std::byte> reply;
    dds::Request request;
    WallClock::time_point until;
  };

  static void Write(Service& service, std::span<const std::byte> reply,
                    const dds::Request& request) {
    const base::MutexLock lock(service.writing);
    service.writer->WriteReply(reply, request.identity);
  }

  void Run() {
    base::MutexLock lock(mutex_);
    for (;;) {
      changed_.wait(lock,
                    [this]() GSV_REQUIRES(mutex_) { return is_stopping_ || !unsent_.empty(); });
      if (is_stopping_) return;
      changed_.wait_for(lock, kRetry, [this]() GSV_REQUIRES(mutex_) { return is_stopping_; });
      std::deque<Unsent> all = std::exchange(unsent_, {});
      lock.unlock();
      const auto is_due = [now = WallClock::now()](const Unsent& each) {
        return now >= each.until ||
               each.service->writer->HasReaderInSameParticipant(each.request.writer);
      };
      const auto due = std::stable_partition(all.begin(), all.end(), is_due);
      for (auto each = all.begin(); each != due; ++each) {
        Write(*each->service, each->reply, each->request);
      }
      lock.lock();
      unsent_.insert(unsent_.begin(), std::make_move_iterator(due),
                     std::make_move_iterator(all.end()));
    }
  }

  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::deque<Unsent> unsent_ GSV_GUARDED_BY(mutex_);
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // declared last, because it uses the members above
};

void ServiceHost::Replier::Send(messages::Bytes response) const {
  const std::shared_ptr<Service> service = service_.lock();
  const std::shared_ptr<Outbox> outbox = service == nullptr ? nullptr : service->outbox.lock();
  if (outbox == nullptr) return;
  if (!header_.empty()) {
    const std::span<const std::byte> whole(response);
    response = Joined(whole.first(kEncapsulation), header_, whole.subspan(kEncapsulation));
  }
  outbox->Send(service, std::move(response), request_);
}

ServiceHost::ServiceHost(dds::Participant& participant, bool has_hashes)
    : participant_(participant),
      has_hashes_(has_hashes),
      outbox_(std::make_shared<Outbox>()),
      quick_(kMaxWaiting),
      slow_(kMaxWaiting),
      stepping_(kMaxWaiting) {}

ServiceHost::~ServiceHost() {
  is_stopping_ = true;
  request_readers_.clear();
  quick_.Stop();
  slow_.Stop();
  stepping_.Stop();
  outbox_->Stop();
}

void ServiceHost::OfferBytes(const std::string& service, const std::string& type, Lane lane,
                             Handler handler) {
  const std::string hash = has_hashes_ ? TypeHashUserData(type) : std::string();
  const ServiceTopic in = RequestTopic(service, type), out = ResponseTopic(service, type);
  const dds::Qos& qos = lane == Lane::kLists ? kListQos : kServiceQos;
  auto writer = participant_.MakeWriter({out.name, out.type, qos, hash}, {});
  if (!writer) {
    spdlog::warn("no ROS 2 service: {}", writer.error().Sentence());
    return;
  }
  const auto offered = std::make_shared<Service>();
  offered->name = service;
  offered->handler = std::move(handler);
  offered->writer = *std::move(writer);
  offered->outbox = outbox_;
  writers_.push_back(offered->writer->guid());
  services_.push_back(offered);
  auto reader = participant_.MakeRequestReader(
      {in.name, in.type, kServiceQos, hash},
      [this, offered, lane](std::span<const std::byte> sample, const dds::Request& request) {
        Enqueue(offered, lane, sample, request);
      });
  if (!reader) {
    spdlog::warn("no ROS 2 service: {}", reader.error().Sentence());
    return;
  }
  readers_.push_back((*reader)->guid());
  request_readers_.push_back(*std::move(reader));
}

dds::Writer* ServiceHost::Advertise(const std::string& topic, const std::string& type,
                                    const dds::Qos& qos) {
  const ServiceTopic names = ActionTopic(topic, type);
  auto writer = participant_.MakeWriter(
      {names.name, names.type, qos, has_hashes_ ? TypeHashUserData(type) : std::string()}, {});
  if (!writer) {
    spdlog::warn("no ROS 2 topic: {}", writer.error().Sentence());
    return nullptr;
  }
  writers_.push_back((*writer)->guid());
  topics_.push_back(*std::move(writer));
  return topics_.back().get();
}

bool ServiceHost::Submit(Lane lane, std::function<void()> job) {
  ServiceWorker& worker = lane == Lane::kSlow       ? slow_
                          : lane == Lane::kStepping ? stepping_
                                                    : quick_;
  return worker.Add(std::move(job));
}

void ServiceHost::Refuse(const std::string& service, const base::Error& error) {
  static base::Mutex mutex;
  static std::set<std::string> refused;
  const base::MutexLock lock(mutex);
  if (!refused.insert(service).second) return;
  spdlog::warn("a request of ROS 2 to {} is ignored: {}", service, error.Sentence());
}

void ServiceHost::Enqueue(const std::shared_ptr<Service>& service, Lane lane,
                          std::span<const std::byte> sample, const dds::Request& request) {
  Replier reply;
  reply.service_ = service;
  reply.request_ = request;
  std::vector<std::byte> body(sample.begin(), sample.end());
  if (HasCycloneHeader(request)) {
    if (sample.size() < kEncapsulation + kCycloneHeader) {
      return Refuse(service->name, {base::ErrorCode::kCorrupt, "it has no header", {}});
    }
    const auto header = sample.subspan(kEncapsulation, kCycloneHeader);
    reply.header_.assign(header.begin(), header.end());
    body =
        Joined(sample.first(kEncapsulation), {}, sample.subspan(kEncapsulation + kCycloneHeader));
  }
  const bool fits = body.size() <= kMaxRequest;
  auto job = [service, reply, body = std::move(body)] { service->handler(body, reply); };
  if (fits && Submit(lane, std::move(job))) return;
  Refuse(service->name, {base::ErrorCode::kUnavailable,
                         fits ? "too many requests wait" : "it is larger than 1 MiB",
                         {}});
}

}  // namespace gsv::ros2
