#include "apps/gsv/running/recorded_images.h"

#include <utility>

#include <fmt/format.h>

namespace gsv::app {

base::Result<std::unique_ptr<RecordedImages>> RecordedImages::Open(const std::string& path) {
  auto reader = recording::McapReader::Open(path);
  if (!reader) return base::Fail(reader.error());
  if ((*reader)->summary().message_count == 0) {
    return base::Fail(base::ErrorCode::kCorrupt, "cannot draw the recording: it has no messages",
                      path);
  }
  auto renderer = rendering::Renderer::Start();
  if (!renderer) return base::Fail(renderer.error());
  return std::unique_ptr<RecordedImages>(
      new RecordedImages(path, *std::move(reader), *std::move(renderer)));
}

base::Status RecordedImages::Check(base::SimTime time) const {
  if (time >= start() && time <= end()) return {};
  return base::Fail(
      base::ErrorCode::kInvalidArgument,
      fmt::format("the time {} s is outside of the recording, which is from {} s to "
                  "{} s",
                  base::ToSeconds(time), base::ToSeconds(start()), base::ToSeconds(end())),
      path_);
}

base::Result<std::shared_ptr<const model::Image>> RecordedImages::Draw(base::SimTime time,
                                                                       const view::Camera& camera) {
  const auto instant = view_.At(time);
  if (!instant) return base::Fail(instant.error());
  if (fixed_ && fixed_->first == camera) return renderer_->Draw(instant->snapshot, fixed_->second);
  const auto placed = view::Place(camera, instant->scene->LookupAt(*instant->snapshot));
  if (!placed) return base::Fail(placed.error());
  if (camera.follow.empty() && camera.sensor.empty()) fixed_.emplace(camera, *placed);
  return renderer_->Draw(instant->snapshot, *placed);
}

}  // namespace gsv::app
