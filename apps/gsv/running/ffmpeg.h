// The program ffmpeg as an encoder, which reads frames from its standard input.
//
// Errors  kUnavailable if there is no ffmpeg. Its own messages go to stderr.
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
  // `program` is found in PATH. `input` and `output` are its options for both; it never overwrites
  // the file `path`. `instead`: what to do without ffmpeg, for the sentence.
  static base::Result<std::unique_ptr<Ffmpeg>> Start(const std::string& program,
                                                     const std::vector<std::string>& input,
                                                     const std::vector<std::string>& output,
                                                     const std::string& path,
                                                     const std::string& instead);
  ~Ffmpeg();
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  // False if it accepts no more.
  bool Write(std::span<const std::uint8_t> bytes);
  // Waits until the file is written; returns whether it was.
  bool Finish();

 private:
  Ffmpeg(pid_t pid, int input);

  pid_t pid_;
  int input_;
  int status_ = -1;
};

}  // namespace gsv::app
