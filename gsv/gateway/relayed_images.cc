#include "gsv/gateway/relayed_images.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "gsv/gateway/drawing/image_parts.h"
#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/transport/tcp.h"
#include "gsv/gateway/upstream/fetch.h"

namespace gsv::gateway {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kThreads = 4;
constexpr std::chrono::seconds kImageTime{30};
// A waiting stream checks at this interval whether the relay has been stopped.
constexpr std::chrono::milliseconds kMaxWait{500};

std::string TimeOf(const Response& image) {
  for (const auto& [name, value] : image.headers) {
    if (name == "Gsv-Time") return value;
  }
  return "0";
}

// Returns the number in the entity tag of an image.
std::string NumberOf(const Response& image) {
  const std::size_t end = image.etag.size();
  return end > 2 ? image.etag.substr(1, end - 2) : std::string();
}

class RelayedStream final : public BodyStream, public std::enable_shared_from_this<RelayedStream> {
 public:
  RelayedStream(boost::asio::io_context& io, upstream::Address address, Request image,
                std::shared_ptr<WorkerPool> pool, std::shared_ptr<int> seat, double frames_a_second)
      : io_(io),
        address_(std::move(address)),
        image_(std::move(image)),
        pool_(std::move(pool)),
        seat_(std::move(seat)),
        period_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / frames_a_second))) {}

  void Begin(Response first) { first_ = std::move(first); }

  void Next(std::function<void(std::optional<SharedBytes>)> take) override {
    if (first_) {
      const Response first = *std::exchange(first_, std::nullopt);
      return take(PartOf(first, true));
    }
    Ask(std::move(take));
  }

 private:
  using Take = std::function<void(std::optional<SharedBytes>)>;

  void Ask(const Take& take) {
    const bool is_accepted =
        pool_->Submit([self = shared_from_this(), take] { self->Fetch(take); });
    if (!is_accepted) take(std::nullopt);
  }

  // Requests the next image. Runs in the pool. The other instance answers the query "after" when
  // there is a newer image. If there is none for a second, it answers with status 204.
  void Fetch(const Take& take) {
    if (Clock::now() < due_) return WaitAndAsk(take);
    Request request = image_;
    if (!number_.empty()) {
      request.raw_target += request.raw_target.find('?') == std::string::npos ? '?' : '&';
      request.raw_target += "after=" + number_;
    }
    const auto answer = upstream::Fetch(address_, request, kImageTime);
    if (!answer || (answer->status != 200 && answer->status != 204)) return take(std::nullopt);
    if (answer->status == 204) return Ask(take);
    take(PartOf(*answer, false));
  }

  void WaitAndAsk(const Take& take) {
    auto timer = std::make_shared<transport::Timer>(
        io_, std::min<Clock::time_point>(due_, Clock::now() + kMaxWait));
    Wait(*timer,
         transport::Completion([self = shared_from_this(), timer, take] { self->Ask(take); }));
  }

  SharedBytes PartOf(const Response& image, bool is_first) {
    number_ = NumberOf(image);
    due_ = Clock::now() + period_;
    return drawing::ImagePart(image.body.view(), TimeOf(image), is_first);
  }

  boost::asio::io_context& io_;
  const upstream::Address address_;
  const Request image_;
  const std::shared_ptr<WorkerPool> pool_;
  const std::shared_ptr<int> seat_;
  const Clock::duration period_;
  std::optional<Response> first_;
  std::string number_;
  Clock::time_point due_{};
};

}  // namespace

RelayedImages::RelayedImages(boost::asio::io_context& io, upstream::Address address)
    : io_(io),
      address_(std::move(address)),
      pool_(std::make_shared<WorkerPool>(kThreads, kWaitingRequests)) {}

RelayedImages::~RelayedImages() { Stop(); }

void RelayedImages::Stop() { pool_->Stop(); }

Response RelayedImages::Open(const Request& request, const Request& image) {
  const auto query = drawing::ParseViewQuery(request.target, true);
  if (!query) return ErrorResponse(query.error());
  const std::shared_ptr<int> seat = seats_;
  if (seat.use_count() > kMaxImageStreams + 1) {
    return ErrorResponse(503, "this relay forwards " + std::to_string(kMaxImageStreams) +
                                  " streams of images already; close one first");
  }
  auto stream =
      std::make_shared<RelayedStream>(io_, address_, image, pool_, seat, query->frames_a_second);
  base::Result<Response> first = upstream::Fetch(address_, image, kImageTime);
  if (!first) return ErrorResponse(first.error());
  if (first->status != 200) return *std::move(first);
  stream->Begin(*std::move(first));
  Response response;
  response.content_type = drawing::kImageStreamType;
  response.allows_other_sites = true;
  response.stream = std::move(stream);
  return response;
}

}  // namespace gsv::gateway
