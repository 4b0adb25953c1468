#include "gsv/gateway/drawing/view_drawer.h"

#include <future>

#include <gtest/gtest.h>

#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/testing/fake_view_source.h"

namespace gsv::gateway::drawing {
namespace {

using namespace std::chrono_literals;
using testing::BorrowedViewSource;
using testing::FakeViewSource;
constexpr auto kLimit = 60s;

class ViewDrawerTest : public ::testing::Test {
 protected:
  ViewDrawerTest() { Show(drawer_); }

  void Show(ViewDrawer& drawer) {
    drawer.SetSource("office", source_,
                     [this] { return std::make_unique<BorrowedViewSource>(source_); });
  }

  static ViewRequest Request(int width = 32) {
    ViewRequest request;
    request.world = "office";
    request.camera.width = width;
    request.camera.height = 24;
    return request;
  }

  std::future<base::Result<DrawnImage>> Ask(const ViewRequest& request, std::uint64_t after = 0,
                                            std::chrono::milliseconds timeout = 30s) {
    auto promise = std::make_shared<std::promise<base::Result<DrawnImage>>>();
    auto future = promise->get_future();
    auto seat = drawer_.Take(request);
    EXPECT_TRUE(seat) << seat.error().Sentence();
    drawer_.Ask(*seat, after, {}, timeout, [promise](base::Result<DrawnImage> image) {
      promise->set_value(std::move(image));
    });
    return future;
  }

  static base::Result<DrawnImage> Get(std::future<base::Result<DrawnImage>>&& future) {
    if (future.wait_for(kLimit) != std::future_status::ready) {
      return base::Fail(base::ErrorCode::kTimeout, "no answer");
    }
    return future.get();
  }

  const std::shared_ptr<FakeViewSource> source_ = std::make_shared<FakeViewSource>();
  ViewDrawer drawer_{DrawingLimits{.views = 2, .viewers = 3, .pixels = 10'000}};
};

TEST_F(ViewDrawerTest, DrawsAtOnceAndThenOnlyOnChange) {
  const auto first = Get(Ask(Request()));
  if (!first && first.error().code == base::ErrorCode::kUnavailable) {
    GTEST_SKIP() << first.error().Sentence();
  }
  ASSERT_TRUE(first) << first.error().Sentence();
  EXPECT_EQ(first->bytes.view().substr(0, 2), "\xff\xd8");
  EXPECT_EQ(first->time, 1s);
  // Without a change, the same image arrives after the timeout.
  const auto same = Get(Ask(Request(), first->number, 1ms));
  ASSERT_TRUE(same);
  EXPECT_EQ(same->number, first->number);
  EXPECT_EQ(same->bytes.data(), first->bytes.data());  // the image was not drawn again
  auto next = Ask(Request(), first->number);
  source_->Change();
  const auto changed = Get(std::move(next));
  ASSERT_TRUE(changed);
  EXPECT_GT(changed->number, first->number);
  EXPECT_EQ(changed->time, 2s);
}

TEST_F(ViewDrawerTest, RequestsWithTheSameCameraShareAnImage) {
  const auto first = Get(Ask(Request()));
  if (!first) GTEST_SKIP() << first.error().Sentence();
  const auto second = Get(Ask(Request()));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->bytes.data(), first->bytes.data());
  const auto other = Get(Ask(Request(33)));
  ASSERT_TRUE(other);
  EXPECT_NE(other->bytes.data(), first->bytes.data());
}

TEST_F(ViewDrawerTest, CountsViewsClientsAndDrawnImages) {
  {
    const auto one = drawer_.Take(Request(32));
    const auto same = drawer_.Take(Request(32));
    const auto other = drawer_.Take(Request(33));
    const metrics::DrawnViews now = drawer_.Counts();
    EXPECT_EQ(now.views, 2u);
    EXPECT_EQ(now.clients, 3u);
    EXPECT_EQ(now.images, 0u);
  }
  EXPECT_EQ(drawer_.Counts().views, 0u);
  EXPECT_EQ(drawer_.Counts().clients, 0u);
  if (const auto first = Get(Ask(Request())); !first) GTEST_SKIP() << first.error().Sentence();
  EXPECT_EQ(drawer_.Counts().images, 1u);
  ASSERT_TRUE(Get(Ask(Request())));
  EXPECT_EQ(drawer_.Counts().images, 1u);  // the second request got the same image
  source_->Change();
  ASSERT_TRUE(Get(Ask(Request())));
  EXPECT_EQ(drawer_.Counts().images, 2u);
}

TEST_F(ViewDrawerTest, AnImageHasItsDepthsOnlyOnRequest) {
  const auto plain = Get(Ask(Request()));
  if (!plain) GTEST_SKIP() << plain.error().Sentence();
  EXPECT_EQ(plain->bytes.view().find("GSV-depth"), std::string_view::npos);
  ViewRequest request = Request();
  request.depth_spacing = 8;
  const auto with_depth = Get(Ask(request));
  ASSERT_TRUE(with_depth) << with_depth.error().Sentence();
  EXPECT_EQ(with_depth->bytes.view().substr(0, 2), "\xff\xd8");
  EXPECT_NE(with_depth->bytes.view().find("GSV-depth"), std::string_view::npos);
}

TEST_F(ViewDrawerTest, LimitsTheNumberOfViewsAndViewers) {
  const auto one = drawer_.Take(Request(32));
  const auto two = drawer_.Take(Request(33));
  ASSERT_TRUE(one && two);
  const auto third_view = drawer_.Take(Request(34));
  ASSERT_FALSE(third_view);
  EXPECT_EQ(third_view.error().message,
            "the server already draws 2 views, which is the limit; close one of them, or "
            "request a view that is already drawn");
  {
    const auto shared = drawer_.Take(Request(33));
    ASSERT_TRUE(shared);
    const auto fourth = drawer_.Take(Request(33));
    ASSERT_FALSE(fourth);
    EXPECT_EQ(fourth.error().code, base::ErrorCode::kUnavailable);
    EXPECT_NE(fourth.error().message.find("3 viewers"), std::string::npos);
  }
  EXPECT_TRUE(drawer_.Take(Request(33)));  // one Seat is free again
  const auto huge = drawer_.Take(Request(4000));
  ASSERT_FALSE(huge);
  EXPECT_EQ(huge.error().code, base::ErrorCode::kInvalidArgument);
}

TEST_F(ViewDrawerTest, AnErrorOfTheSourceReachesEveryViewer) {
  source_->has_ended = true;
  const auto image = Get(Ask(Request()));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().message, "the simulation has been removed");
}

TEST_F(ViewDrawerTest, ACameraThatCannotBePlacedIsAnError) {
  ViewRequest request = Request();
  request.camera.follow = "nobody";
  const auto image = Get(Ask(request));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, base::ErrorCode::kNotFound);
}

TEST_F(ViewDrawerTest, StoppingAnswersPendingRequests) {
  const auto first = Get(Ask(Request()));
  auto waiting = Ask(Request(), first ? first->number : 1);
  drawer_.Stop();
  const auto image = Get(std::move(waiting));
  ASSERT_FALSE(image);
  EXPECT_EQ(Get(Ask(Request())).error().code, base::ErrorCode::kEnded);
}

base::Result<ViewQuery> Parsed(const std::string& query, bool is_stream = false) {
  return ParseViewQuery(*ParseTarget("/view.jpg?" + query), is_stream);
}

TEST(ViewQuery, ReadsTheCamera) {
  const auto query =
      Parsed("size=320x200&pixel_ratio=1.5&eye=1,2,3&target=4,5,6&fov=60&quality=50&after=7");
  ASSERT_TRUE(query) << query.error().Sentence();
  EXPECT_EQ(query->view.camera.width, 480);
  EXPECT_EQ(query->view.camera.height, 300);
  EXPECT_EQ(query->view.camera.eye, (geometry::Vector3{1, 2, 3}));
  EXPECT_EQ(query->view.camera.field_of_view, 60);
  EXPECT_EQ(query->view.quality, 50);
  EXPECT_EQ(query->after, 7u);
  EXPECT_EQ(query->view.depth_spacing, 0);
  EXPECT_EQ(Parsed("size=1366x768&depth=8")->view.depth_spacing, 8);
  EXPECT_DOUBLE_EQ(Parsed("fps=5", true)->frames_a_second, 5);
}

TEST(ViewQuery, RefusesInvalidParameters) {
  for (const char* query :
       {"size=0x0", "size=100000x100000", "size=big", "eye=1,2,3", "eye=1&target=2", "fov=0",
        "quality=0", "quality=x", "after=-1", "pixel_ratio=9", "size=4000x4000&pixel_ratio=4",
        "fps=5", "eys=1,2,3", "camera=pebble", "depth=3", "depth=65", "depth=8.5", "depth=4"}) {
    const auto parsed = Parsed(query);
    ASSERT_FALSE(parsed) << query;
    EXPECT_EQ(parsed.error().code, base::ErrorCode::kInvalidArgument) << query;
    EXPECT_FALSE(parsed.error().message.empty());
  }
  EXPECT_NE(Parsed("eys=1,2,3").error().message.find("there is no parameter 'eys'; use"),
            std::string::npos);
}

}  // namespace
}  // namespace gsv::gateway::drawing
