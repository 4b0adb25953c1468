// Exports the images of one topic of a recording as a video, using ffmpeg.
//
// Errors  kUnavailable if ffmpeg is missing; kInvalidArgument if the topic has no images, or if the
//         file exists already.
#pragma once

#include <string>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::app {

struct VideoOptions {
  std::string output;  // the extension selects the format, for example .mp4
  double frames_a_second = 25;
  std::string ffmpeg = "ffmpeg";  // searched on the PATH
};

// Exports the video and returns the number of frames. One second of the video shows one second of
// simulated time. Each frame shows the newest image that was recorded at or before its time.
base::Result<std::uint64_t> ExportVideo(const recording::McapReader& reader,
                                        const recording::Selection& selection,
                                        const VideoOptions& options);

}  // namespace gsv::app
