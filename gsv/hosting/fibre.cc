#include "gsv/hosting/fibre.h"

#include <boost/context/protected_fixedsize_stack.hpp>

#include "gsv/base/check.h"

namespace gsv::hosting {
namespace {

// Of address space; only what is touched costs memory. A page that may not be touched lies below.
constexpr std::size_t kStackBytes = 256u << 10;

}  // namespace

Fibre::Fibre(std::function<void()> body)
    : body_(std::move(body)),
      inside_(std::allocator_arg, boost::context::protected_fixedsize_stack(kStackBytes),
              [this](boost::context::fiber&& outside) {
                outside_ = std::move(outside);
                body_();
                has_ended_ = true;
                return std::move(outside_);
              }) {}

void Fibre::Resume() {
  GSV_CHECK(!has_ended_);
  inside_ = std::move(inside_).resume();
}

void Fibre::Suspend() { outside_ = std::move(outside_).resume(); }

}  // namespace gsv::hosting
