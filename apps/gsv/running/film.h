// Writes frames to a film: a video (.webm, .mp4) by ffmpeg, an animated PNG (.apng), or a new
// folder of PNG files.
//
// Errors   kInvalidArgument if the name has another extension or exists already. kUnavailable with
//          the reason if the film cannot be written, or if ffmpeg is missing for a video. An
//          unfinished film is removed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/model/image.h"

namespace gsv::app {

struct FilmOptions {
  std::string output;             // file or folder of the film; its extension selects the format
  double frames_a_second = 25;    // frames per second of the film
  std::uint64_t frames = 0;       // the number of frames that will be added
  int width = 0, height = 0;      // size of the frames, pixels
  std::string ffmpeg = "ffmpeg";  // searched on the PATH
};

// Returns a sentence if the name is not valid for a film, else an empty text.
std::string CheckFilmName(const std::string& path);

// A film that is being written.
class Film {
 public:
  // Starts to write a film.
  static base::Result<std::unique_ptr<Film>> Start(const FilmOptions& options);
  virtual ~Film() = default;

  // Adds an RGB image of the film's size.
  virtual base::Status Add(const model::Image& image) = 0;
  // Completes the film. Without this call, the destructor removes it.
  virtual base::Status Finish() = 0;
};

}  // namespace gsv::app
