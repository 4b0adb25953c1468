// A function with its own stack, implemented with Boost.Context. It can be suspended and resumed
// later, on any thread.
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
  // `body` begins at the first Resume(). It must not throw.
  explicit Fibre(std::function<void()> body);
  // Unwinds the body if it is suspended.
  ~Fibre();
  Fibre(const Fibre&) = delete;
  Fibre& operator=(const Fibre&) = delete;

  // Runs the body until it calls Suspend() or returns. Called from outside of the body.
  void Resume();
  // Suspends the body and returns from Resume(). Called from the body.
  void Suspend();

  bool has_ended() const { return has_ended_; }

 private:
  Fibre(std::function<void()> body, boost::context::stack_context stack);

  std::function<void()> body_;
  bool has_ended_ = false;
  SanitizerStack stack_;
  boost::context::fiber inside_, outside_;  // the suspended body, and the caller of Resume()
};

}  // namespace gsv::hosting
