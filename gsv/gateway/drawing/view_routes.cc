#include "gsv/gateway/drawing/view_routes.h"

#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "gsv/gateway/drawing/image_parts.h"
#include "gsv/gateway/http/body_stream.h"
#include "gsv/rendering/images/depth_segment.h"

namespace gsv::gateway::drawing {
namespace {

using base::ErrorCode;
using base::Fail;
using Clock = ViewDrawer::Clock;

// The time after which a client gets an answer even if nothing has changed.
constexpr std::chrono::milliseconds kTimeout{1000}, kStreamTimeout{5000};
constexpr int kMinDepthSpacing = 4, kMaxDepthSpacing = 64;  // pixels

template <typename Number>
std::optional<Number> WholeText(const std::string& text) {
  Number value{};
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  return is_whole ? std::optional(value) : std::nullopt;
}

base::Result<double> NumberBetween(const std::string& name, const std::string& text, double low,
                                   double high) {
  const auto value = WholeText<double>(text);
  if (value && *value >= low && *value <= high) return *value;
  return Fail(ErrorCode::kInvalidArgument,
              fmt::format("the parameter {} must be {} to {}, but it is '{}'", name, low, high,
                          text.substr(0, 64)));
}

// Sets a parameter of the camera.
base::Status SetCamera(const std::string& name, const std::string& value, view::Camera& camera) {
  const auto set_point = [&](std::optional<geometry::Vector3>& point) -> base::Status {
    auto parsed = view::ParsePoint(value, "the parameter " + name);
    if (!parsed) return Fail(parsed.error());
    point = *parsed;
    return {};
  };
  if (name == "size") return view::SetSize(value, camera);
  if (name == "azimuth" || name == "elevation" || name == "zoom") {
    return view::SetSide(name, value, camera.side);
  }
  if (name == "eye") return set_point(camera.eye);
  if (name == "target") return set_point(camera.target);
  if (name == "follow") camera.follow = value;
  if (name == "camera") camera.sensor = value;
  if (name != "fov") return {};
  auto angle = view::ParseFieldOfView(value);
  if (!angle) return Fail(angle.error());
  camera.field_of_view = *angle;
  return {};
}

base::Status SetParameter(const std::string& name, const std::string& value, double& pixel_ratio,
                          ViewQuery& query) {
  const auto set = [&](double& target, double low, double high) -> base::Status {
    auto number = NumberBetween(name, value, low, high);
    if (!number) return Fail(number.error());
    target = *number;
    return {};
  };
  if (name == "pixel_ratio") return set(pixel_ratio, 0.1, 4);
  if (name == "fps") return set(query.frames_a_second, 0.1, 60);
  if (name == "quality") {
    double quality = 0;
    if (auto ok = set(quality, 1, 100); !ok) return ok;
    query.view.quality = static_cast<int>(quality);
    return {};
  }
  if (name == "depth") {
    const auto spacing = WholeText<int>(value);
    if (spacing && *spacing >= kMinDepthSpacing && *spacing <= kMaxDepthSpacing) {
      query.view.depth_spacing = *spacing;
      return {};
    }
    return Fail(ErrorCode::kInvalidArgument,
                fmt::format("the parameter depth must be a whole number from {} to {}, but it is "
                            "'{}'",
                            kMinDepthSpacing, kMaxDepthSpacing, value.substr(0, 64)));
  }
  if (name == "after") {
    query.after = WholeText<std::uint64_t>(value);
    if (query.after) return {};
    return Fail(ErrorCode::kInvalidArgument,
                "the parameter 'after' must be the number in the ETag of an image");
  }
  return SetCamera(name, value, query.view.camera);
}

class ImageStream final : public BodyStream, public std::enable_shared_from_this<ImageStream> {
 public:
  ImageStream(ViewDrawer& drawer, std::shared_ptr<ViewDrawer::Seat> seat, double frames_a_second,
              DrawnImage first)
      : drawer_(drawer),
        seat_(std::move(seat)),
        period_(std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / frames_a_second))),
        first_(std::move(first)) {}

  void Next(std::function<void(std::optional<SharedBytes>)> take) override {
    if (first_) {
      const DrawnImage first = *std::exchange(first_, std::nullopt);
      return take(PartOf(first, true));
    }
    drawer_.Ask(seat_, last_, due_, kStreamTimeout,
                [self = shared_from_this(), take](base::Result<DrawnImage> image) {
                  take(image ? std::optional(self->PartOf(*image, false)) : std::nullopt);
                });
  }

 private:
  SharedBytes PartOf(const DrawnImage& image, bool is_first) {
    last_ = image.number;
    due_ = Clock::now() + period_;
    return ImagePart(image.bytes.view(), fmt::format("{:.6f}", base::ToSeconds(image.time)),
                     is_first);
  }

  ViewDrawer& drawer_;
  const std::shared_ptr<ViewDrawer::Seat> seat_;
  const Clock::duration period_;
  std::optional<DrawnImage> first_;
  std::uint64_t last_ = 0;
  Clock::time_point due_{};
};

Response ImageResponse(const DrawnImage& image, const ViewQuery& query) {
  Response response;
  response.etag = fmt::format("\"{}\"", image.number);
  response.headers.emplace_back("Gsv-Time", fmt::format("{:.6f}", base::ToSeconds(image.time)));
  response.allows_other_sites = true;
  if (query.after && *query.after == image.number) {
    response.status = 204;
    return response;
  }
  response.content_type = query.view.format == ImageFormat::kPng ? "image/png" : "image/jpeg";
  response.body = image.bytes;
  return response;
}

class ViewHandler {
 public:
  ViewHandler(ViewDrawer& drawer, FindWorld find, ImageFormat format, bool is_stream)
      : drawer_(drawer), find_(std::move(find)), format_(format), is_stream_(is_stream) {}

  void operator()(const Request& request, const Respond& respond) const {
    auto query = ParseViewQuery(request.target, is_stream_);
    if (!query) return respond(ErrorResponse(query.error()));
    const auto world = find_(request);
    if (!world) return respond(ErrorResponse(world.error()));
    query->view.world = world->name;
    query->view.format = format_;
    if (format_ == ImageFormat::kPng && query->view.depth_spacing > 0) {
      return respond(ErrorResponse({ErrorCode::kInvalidArgument,
                                    "a PNG contains no depths; leave out the parameter depth, or "
                                    "request /view.jpg",
                                    {}}));
    }
    auto seat = drawer_.Take(query->view);
    if (!seat) return respond(ErrorResponse(seat.error()));
    drawer_.SetSource(world->name, world->identity, world->make);
    is_stream_ ? BeginStream(*std::move(seat), *query, respond)
               : AnswerOnce(*std::move(seat), *query, respond);
  }

 private:
  void AnswerOnce(std::shared_ptr<ViewDrawer::Seat> seat, const ViewQuery& query,
                  const Respond& respond) const {
    drawer_.Ask(std::move(seat), query.after.value_or(0), {}, kTimeout,
                [query, respond](const base::Result<DrawnImage>& image) {
                  respond(image ? ImageResponse(*image, query) : ErrorResponse(image.error()));
                });
  }

  void BeginStream(const std::shared_ptr<ViewDrawer::Seat>& seat, const ViewQuery& query,
                   const Respond& respond) const {
    drawer_.Ask(seat, 0, {}, kTimeout,
                [&drawer = drawer_, seat, rate = query.frames_a_second,
                 respond](const base::Result<DrawnImage>& image) {
                  if (!image) return respond(ErrorResponse(image.error()));
                  Response response;
                  response.content_type = kImageStreamType;
                  response.allows_other_sites = true;
                  response.stream = std::make_shared<ImageStream>(drawer, seat, rate, *image);
                  respond(std::move(response));
                });
  }

  ViewDrawer& drawer_;
  const FindWorld find_;
  const ImageFormat format_;
  const bool is_stream_;
};

}  // namespace

base::Result<ViewQuery> ParseViewQuery(const Target& target, bool is_stream) {
  static const std::set<std::string> kOfAll{
      "simulation", "size",    "pixel_ratio", "eye",     "target",    "follow", "camera", "fov",
      "zoom",       "quality", "token",       "azimuth", "elevation", "depth",  "_"};
  ViewQuery query;
  double pixel_ratio = 1;
  for (const auto& [name, value] : target.query) {
    if (!kOfAll.contains(name) && name != (is_stream ? "fps" : "after")) {
      return Fail(ErrorCode::kInvalidArgument,
                  "there is no parameter '" + name.substr(0, 64) +
                      "'; use simulation, size, pixel_ratio, eye, target, follow, camera, fov, "
                      "azimuth, elevation, zoom, quality, depth or " +
                      (is_stream ? "fps" : "after"));
    }
    if (auto set = SetParameter(name, value, pixel_ratio, query); !set) return Fail(set.error());
  }
  view::Camera& camera = query.view.camera;
  camera.width = static_cast<int>(std::lround(camera.width * pixel_ratio));
  camera.height = static_cast<int>(std::lround(camera.height * pixel_ratio));
  if (auto ok = view::Check(camera); !ok) return Fail(ok.error());
  if (const int spacing = query.view.depth_spacing; spacing > 0) {
    const int samples = rendering::DepthSamples(camera.width, spacing) *
                        rendering::DepthSamples(camera.height, spacing);
    if (samples > rendering::kMaxDepthSamples) {
      return Fail(
          ErrorCode::kInvalidArgument,
          fmt::format("depth={} gives {} depth values, but the limit is {}; use a larger spacing",
                      spacing, samples, rendering::kMaxDepthSamples));
    }
  }
  return query;
}

std::vector<Route> ViewRoutes(const std::string& prefix, ViewDrawer& drawer,
                              const FindWorld& find) {
  std::vector<Route> routes;
  const auto add = [&](const char* name, ImageFormat format, bool is_stream, const char* summary) {
    Route route{"GET", prefix + name, Permission::kWatch, false, Pool::kReaders};
    route.summary = summary;
    route.accepts_token_in_query = true;
    route.later = ViewHandler(drawer, find, format, is_stream);
    routes.push_back(std::move(route));
  };
  add("/view.jpg", ImageFormat::kJpeg, false,
      "Draw an image of a simulation or of a replay, as JPEG");
  add("/view.png", ImageFormat::kPng, false,
      "Draw an image of a simulation or of a replay, as PNG");
  add("/view.mjpeg", ImageFormat::kJpeg, true,
      "Draw a simulation or a replay as a stream of JPEG images");
  return routes;
}

}  // namespace gsv::gateway::drawing
