// The pictures of one topic of a recording as a video, made by ffmpeg.
//
// Errors  kUnavailable when there is no ffmpeg; kInvalidArgument when the topic holds no pictures,
//         or the file is there already.
#pragma once

#include <string>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::app {

struct VideoOptions {
  std::string output;  // the ending says which kind: .mp4
  double frames_a_second = 25;
  std::string ffmpeg = "ffmpeg";  // looked for in PATH
};

// A frame shows the newest picture by its instant, so that a recorded second is one in the video.
// Returns how many frames there are.
base::Result<std::uint64_t> ExportVideo(const recording::McapReader& reader,
                                        const recording::Selection& selection,
                                        const VideoOptions& options);

}  // namespace gsv::app
