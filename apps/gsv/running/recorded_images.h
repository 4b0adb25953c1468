// Renders images of a recording, without a browser.
//
// Errors   the errors of the recording, of the camera and of the renderer.
// Threads  one at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/gateway/recorded/recorded_view.h"
#include "gsv/rendering/renderer.h"
#include "gsv/view/camera.h"

namespace gsv::app {

class RecordedImages {
 public:
  // Opens a recording.
  static base::Result<std::unique_ptr<RecordedImages>> Open(const std::string& path);

  base::SimTime start() const { return reader_->summary().start; }
  base::SimTime end() const { return reader_->summary().end; }
  // Returns kInvalidArgument, with the recorded range, if the time is outside the recording.
  base::Status Check(base::SimTime time) const;

  // Renders the recorded world at a time. If the camera follows no robot and is no robot's sensor,
  // its pose is computed at the first call with this camera. Later calls use the same pose.
  base::Result<std::shared_ptr<const model::Image>> Draw(base::SimTime time,
                                                         const view::Camera& camera);

 private:
  RecordedImages(std::string path, std::unique_ptr<recording::McapReader> reader,
                 std::shared_ptr<rendering::Renderer> renderer)
      : path_(std::move(path)),
        reader_(std::move(reader)),
        renderer_(std::move(renderer)),
        scene_(*reader_),
        view_(*reader_, scene_) {}

  const std::string path_;
  const std::unique_ptr<recording::McapReader> reader_;
  const std::shared_ptr<rendering::Renderer> renderer_;
  const gateway::RecordedScene scene_;
  gateway::RecordedView view_;
  // The last camera that follows no robot and is no robot's sensor, and its computed view.
  std::optional<std::pair<view::Camera, rendering::CameraView>> fixed_;
};

}  // namespace gsv::app
