// The program ffmpeg as an encoder, which reads frames from its standard input.
//
// Errors  kUnavailable if there is no ffmpeg. Messages of ffmpeg go to stderr.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

class Ffmpeg {
 public:
  // Starts `program`, which is searched on the PATH, with its options for `input` and `output`. The
  // program never overwrites the file `path`. If the program is missing, the error's sentence ends
  // with `instead`, which should name an alternative to ffmpeg.
  static base::Result<std::unique_ptr<Ffmpeg>> Start(const std::string& program,
                                                     const std::vector<std::string>& input,
                                                     const std::vector<std::string>& output,
                                                     const std::string& path,
                                                     const std::string& instead);
  ~Ffmpeg();
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  // Returns false if ffmpeg accepts no more input.
  bool Write(std::span<const std::uint8_t> bytes);
  // Waits until the file is written. Returns whether this succeeded.
  bool Finish();

 private:
  Ffmpeg(pid_t pid, int input);

  pid_t pid_;
  int input_;  // descriptor of ffmpeg's stdin; -1 after Finish()
  int status_ = -1;
};

}  // namespace gsv::app
