// Tests images that a server sends to the clients of a hub while the world and their cameras
// change.
#include "gsv/gateway/drawing/pushed_views.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <deque>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/testing/fake_view_source.h"
#include "gsv/gateway/testing/recording_client.h"

namespace gsv::gateway::drawing {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::BorrowedViewSource;
using testing::FakeViewSource;

constexpr auto kPatience = 60s;
constexpr foxglove::SubscriptionId kView = 7;

struct PushedImage {
  std::uint32_t subscription = 0, sequence = 0;
  std::uint64_t time_ns = 0, number = 0, seen_us = 0;
  std::string jpeg;
};

// A client that waits for images and failures.
class ViewClient final : public Client {
 public:
  void SendText(SharedBytes text) override {
    const json message = json::parse(text.view());
    const base::MutexLock lock(mutex_);
    if (message["op"] == "gsvViewFailure") failures_.push_back(message["message"]);
    if (message["op"] == "serverInfo") capabilities_ = message["capabilities"];
    changed_.notify_all();
  }
  void SendBytes(SharedBytes bytes) override {
    const base::MutexLock lock(mutex_);
    images_.push_back(Parsed(std::string(bytes.view())));
    changed_.notify_all();
  }
  void SendData(const foxglove::BinaryHeader&, SharedBytes, Delivery) override {}
  void Close(CloseCode, std::string) override {}

  PushedImage NextImage() {
    base::MutexLock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience,
                                  [this]() GSV_REQUIRES(mutex_) { return !images_.empty(); }));
    if (images_.empty()) return {};
    PushedImage image = images_.front();
    images_.pop_front();
    return image;
  }
  std::string NextFailure() {
    base::MutexLock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience,
                                  [this]() GSV_REQUIRES(mutex_) { return !failures_.empty(); }));
    if (failures_.empty()) return {};
    std::string failure = failures_.front();
    failures_.pop_front();
    return failure;
  }
  double slow_rate() const override { return slow_rate_; }
  void set_slow_rate(double rate) { slow_rate_ = rate; }
  bool has_images() {
    const base::MutexLock lock(mutex_);
    return !images_.empty();
  }
  json capabilities() {
    const base::MutexLock lock(mutex_);
    return capabilities_;
  }

 private:
  static PushedImage Parsed(const std::string& bytes) {
    PushedImage image;
    EXPECT_EQ(bytes.at(0), 1);
    std::memcpy(&image.subscription, &bytes.at(1), 4);
    std::memcpy(&image.time_ns, &bytes.at(5), 8);
    std::memcpy(&image.sequence, &bytes.at(13), 4);
    std::memcpy(&image.number, &bytes.at(17), 8);
    std::memcpy(&image.seen_us, &bytes.at(25), 8);
    image.jpeg = bytes.substr(33);
    return image;
  }

  std::atomic<double> slow_rate_{0};
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::deque<PushedImage> images_ GSV_GUARDED_BY(mutex_);
  std::deque<std::string> failures_ GSV_GUARDED_BY(mutex_);
  json capabilities_ GSV_GUARDED_BY(mutex_);
};

class PushedViewsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    hub_.Offer(std::make_shared<PushedViews>(drawer_, [this] {
      return base::Result<ViewedWorld>(ViewedWorld{
          "office", source_, [this] { return std::make_unique<BorrowedViewSource>(source_); }});
    }));
    hub_.Add(client_);
    if (const auto renderer = rendering::Renderer::Start(); !renderer) {
      GTEST_SKIP() << renderer.error().Sentence();
    }
  }
  void TearDown() override { drawer_.Stop(); }

  void Send(const json& message, const std::shared_ptr<ViewClient>& client) {
    EXPECT_TRUE(hub_.Receive(client.get(), message.dump()));
  }
  void Send(const json& message) { Send(message, client_); }
  static json Watch(const std::string& camera, std::uint32_t sequence,
                    foxglove::SubscriptionId view = kView) {
    return {{"op", "gsvSubscribeView"}, {"id", view}, {"camera", camera}, {"sequence", sequence}};
  }
  static json Shown(const PushedImage& image) {
    return {{"op", "gsvViewShown"}, {"id", kView}, {"image", image.number}};
  }

  const std::shared_ptr<FakeViewSource> source_ = std::make_shared<FakeViewSource>();
  ViewDrawer drawer_{DrawingLimits{.views = 4, .viewers = 5, .pixels = 10'000}};
  Hub hub_{{"test", {}, {}, "1"}, [] {}};
  const std::shared_ptr<ViewClient> client_ = std::make_shared<ViewClient>();
};

TEST_F(PushedViewsTest, TheServerOffersViews) {
  const json capabilities = client_->capabilities();
  EXPECT_NE(std::find(capabilities.begin(), capabilities.end(), "gsvViews"), capabilities.end());
}

TEST_F(PushedViewsTest, SendsAnImageAtOnceAndThenOneForEachChange) {
  Send(Watch("size=32x24&fps=60", 3));
  const PushedImage first = client_->NextImage();
  EXPECT_EQ(first.subscription, kView);
  EXPECT_EQ(first.sequence, 3u);
  EXPECT_EQ(first.time_ns, 1'000'000'000u);
  EXPECT_GT(first.seen_us, 0u);
  EXPECT_EQ(first.jpeg.substr(0, 2), "\xff\xd8");
  Send(Shown(first));
  EXPECT_FALSE(client_->has_images());
  source_->Change();
  const PushedImage next = client_->NextImage();
  EXPECT_EQ(next.time_ns, 2'000'000'000u);
  EXPECT_GT(next.number, first.number);
}

TEST_F(PushedViewsTest, AnotherCameraGetsAnImageAtOnce) {
  Send(Watch("size=32x24", 1));
  const PushedImage first = client_->NextImage();
  EXPECT_EQ(first.sequence, 1u);
  Send(Shown(first));
  for (std::uint32_t sequence = 2; sequence <= 20; ++sequence) {
    Send(
        Watch("fps=60&size=32x24&eye=" + std::to_string(sequence) + ",2,2&target=0,0,0", sequence));
  }
  PushedImage image;
  do {
    image = client_->NextImage();
    ASSERT_FALSE(image.jpeg.empty());
    Send(Shown(image));
  } while (image.sequence != 20);  // earlier cameras may have been skipped
}

TEST_F(PushedViewsTest, AClientThatReportsNoImagesGetsFewImages) {
  Send(Watch("size=32x24&fps=60", 1));
  const std::shared_ptr<ViewClient> other = std::make_shared<ViewClient>();
  hub_.Add(other);
  Send(Watch("size=32x24&fps=60", 1), other);
  // The other client reports each image as shown, and gets further images. `client_` reports no
  // image as shown, so it gets at most two.
  for (int i = 0; i < 5; ++i) {
    Send(Shown(other->NextImage()), other);
    source_->Change();
  }
  int received = 0;
  for (; client_->has_images(); ++received) (void)client_->NextImage();
  EXPECT_GE(received, 1);
  EXPECT_LE(received, 2);
}

TEST_F(PushedViewsTest, ASlowConnectionGetsSmallerImages) {
  client_->set_slow_rate(1);  // every image is too large
  Send(Watch("size=100x100&fps=60&quality=100", 1));
  const PushedImage first = client_->NextImage();
  std::size_t last = first.jpeg.size();
  for (int i = 0; i < 4; ++i) {
    Send(Shown(i == 0 ? first : PushedImage{.number = 1}));
    const PushedImage next = client_->NextImage();
    EXPECT_EQ(next.sequence, 1u);
    EXPECT_LE(next.jpeg.size(), last);
    last = next.jpeg.size();
  }
  EXPECT_LT(last, first.jpeg.size());
}

TEST_F(PushedViewsTest, ViewsWithTheSameCameraShareAnImage) {
  const std::shared_ptr<ViewClient> other = std::make_shared<ViewClient>();
  hub_.Add(other);
  Send(Watch("size=32x24", 1));
  Send(Watch("size=32x24", 9), other);
  EXPECT_EQ(client_->NextImage().jpeg, other->NextImage().jpeg);
}

TEST_F(PushedViewsTest, ReportsWhyAViewIsNotDrawn) {
  Send(Watch("size=0x0", 1));
  EXPECT_NE(client_->NextFailure().find("16 to 4096 pixels"), std::string::npos);
  Send(Watch("size=32x24&follow=nobody", 1));
  EXPECT_NE(client_->NextFailure().find("nobody"), std::string::npos);
  Send(Watch("%", 1));
  EXPECT_FALSE(client_->NextFailure().empty());
  for (foxglove::SubscriptionId view = 1; view <= 5; ++view) Send(Watch("size=32x24", 1, view));
  EXPECT_EQ(client_->NextFailure(), "a client can have at most 4 views; unsubscribe one of them");
}

TEST_F(PushedViewsTest, ABadMessageEndsTheConnection) {
  for (const json& bad :
       {json{{"op", "gsvSubscribeView"}, {"id", 1}},
        json{{"op", "gsvSubscribeView"},
             {"id", 1},
             {"sequence", 1},
             {"camera", std::string(2000, 'x')}},
        json{{"op", "gsvUnsubscribeView"}}, json{{"op", "gsvViewShown"}, {"id", 1}}}) {
    EXPECT_FALSE(hub_.Receive(client_.get(), bad.dump())) << bad;
  }
}

TEST_F(PushedViewsTest, AViewThatEndsMakesAnotherViewPossible) {
  for (int i = 0; i < 6; ++i) {
    Send(Watch("size=32x" + std::to_string(24 + i), 1));
    EXPECT_FALSE(client_->NextImage().jpeg.empty());
    Send({{"op", "gsvUnsubscribeView"}, {"id", kView}});
  }
  for (int i = 0; i < 6; ++i) {
    const auto other = std::make_shared<ViewClient>();
    hub_.Add(other);
    Send(Watch("size=40x" + std::to_string(24 + i), 1), other);
    EXPECT_FALSE(other->NextImage().jpeg.empty());
    hub_.Remove(other.get());
  }
}

TEST_F(PushedViewsTest, AServerWithoutViewsRefusesThem) {
  Hub plain{{"test", {}, {}, "1"}, [] {}};
  const auto other = std::make_shared<ViewClient>();
  plain.Add(other);
  EXPECT_TRUE(plain.Receive(other.get(), Watch("size=32x24", 1).dump()));
  EXPECT_EQ(other->NextFailure(), "this server draws no views");
}

}  // namespace
}  // namespace gsv::gateway::drawing
