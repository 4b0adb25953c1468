// A function with a stack of its own that can be left in the middle and gone on with later, on any
// thread. (Boost.Context does the switching.)
//
// Threads  one at a time.
#pragma once

#include <cstddef>
#include <functional>

#include <boost/context/fiber.hpp>

namespace gsv::hosting {

class Fibre {
 public:
  // `body` begins with the first Resume(). It lets no exception out.
  explicit Fibre(std::function<void()> body);

  // From outside: runs until the body suspends itself or has returned.
  void Resume();
  // From within the body: goes back to who resumed it.
  void Suspend();

  bool has_ended() const { return has_ended_; }

 private:
  std::function<void()> body_;
  bool has_ended_ = false;
  boost::context::fiber inside_, outside_;
};

}  // namespace gsv::hosting
