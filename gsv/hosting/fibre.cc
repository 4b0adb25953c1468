#include "gsv/hosting/fibre.h"

#include <boost/context/preallocated.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>

#include "gsv/base/check.h"

namespace gsv::hosting {
namespace {

using Stacks = boost::context::protected_fixedsize_stack;

// The size of a fibre's stack in the address space. Only used pages cost memory. There is a guard
// page below the stack.
constexpr std::size_t kStackBytes = 256u << 10;

// Notifies the sanitizer that the thread leaves the fibre's stack for the last time, after the body
// has returned or was unwound.
struct Departure {
  SanitizerStack& stack;
  ~Departure() { stack.BeforeLeavingForGood(); }
};

}  // namespace

Fibre::Fibre(std::function<void()> body) : Fibre(std::move(body), Stacks(kStackBytes).allocate()) {}

Fibre::Fibre(std::function<void()> body, boost::context::stack_context stack)
    : body_(std::move(body)), stack_(static_cast<const char*>(stack.sp) - stack.size, stack.size) {
  stack_.BeforePreparing();
  inside_ = boost::context::fiber(std::allocator_arg,
                                  boost::context::preallocated(stack.sp, stack.size, stack),
                                  Stacks(kStackBytes), [this](boost::context::fiber&& outside) {
                                    const Departure departure{stack_};
                                    stack_.AfterEntering();
                                    outside_ = std::move(outside);
                                    body_();
                                    has_ended_ = true;
                                    return std::move(outside_);
                                  });
  stack_.AfterPreparing();
}

Fibre::~Fibre() {
  if (!inside_) return;
  stack_.BeforeEntering();
  inside_ = {};
  stack_.AfterLeaving();
}

void Fibre::Resume() {
  GSV_CHECK(!has_ended_);
  stack_.BeforeEntering();
  inside_ = std::move(inside_).resume();
  stack_.AfterLeaving();
}

void Fibre::Suspend() {
  // The destructor notifies the sanitizer that the thread is on the fibre's stack again. It runs
  // both when resume() returns and when resume() throws the exception that unwinds the body.
  struct Arrival {
    SanitizerStack& stack;
    ~Arrival() { stack.AfterEntering(); }
  } const arrival{stack_};
  stack_.BeforeLeaving();
  outside_ = std::move(outside_).resume();
}

}  // namespace gsv::hosting
