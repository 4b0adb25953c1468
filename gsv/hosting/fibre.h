// A function with a stack of its own that can be left in the middle and gone on with later, on any
// thread. (Boost.Context does the switching.)
//
// Threads  one at a time.
#pragma once

#include <cstddef>
#include <functional>

#include <boost/context/fiber.hpp>
#include <boost/context/stack_context.hpp>

#include "gsv/hosting/sanitizer_stack.h"

namespace gsv::hosting {

class Fibre {
 public:
  // `body` begins with the first Resume(). It lets no exception out.
  explicit Fibre(std::function<void()> body);
  // A body that has suspended itself is unwound.
  ~Fibre();
  Fibre(const Fibre&) = delete;
  Fibre& operator=(const Fibre&) = delete;

  // From outside: runs until the body suspends itself or has returned.
  void Resume();
  // From within the body: goes back to who resumed it.
  void Suspend();

  bool has_ended() const { return has_ended_; }

 private:
  Fibre(std::function<void()> body, boost::context::stack_context stack);

  std::function<void()> body_;
  bool has_ended_ = false;
  SanitizerStack stack_;
  boost::context::fiber inside_, outside_;
};

}  // namespace gsv::hosting
