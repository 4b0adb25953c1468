// What is to be done once bytes have come or gone: any handler of Boost.Asio's, behind one type.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include <boost/system/error_code.hpp>

namespace gsv::gateway::transport {

// Called once. Can be moved, as handlers can; an executor or allocator that a handler brings along
// is not asked for.
class Completion {
 public:
  // `then` takes what a Completion is called with, or the error alone.
  template <typename Then>
  // NOLINTNEXTLINE(bugprone-forwarding-reference-overload)
  requires(!std::is_same_v<std::remove_cvref_t<Then>, Completion>) explicit Completion(Then&& then)
      : step_(std::make_unique<Step<std::remove_cvref_t<Then>>>(std::forward<Then>(then))) {}

  void operator()(boost::system::error_code error, std::size_t bytes = 0) {
    // What it holds is gone by the time the next is begun, as with Boost.Asio's own.
    std::exchange(step_, nullptr)->Take(error, bytes);
  }

 private:
  struct AnyStep {
    virtual ~AnyStep() = default;
    virtual void Take(boost::system::error_code error, std::size_t bytes) = 0;
  };

  template <typename Then>
  struct Step final : AnyStep {
    explicit Step(Then next) : then(std::move(next)) {}
    void Take(boost::system::error_code error, std::size_t bytes) override {
      if constexpr (std::is_invocable_v<Then&, boost::system::error_code, std::size_t>) {
        then(error, bytes);
      } else {
        then(error);
      }
    }
    Then then;
  };

  std::unique_ptr<AnyStep> step_;
};

}  // namespace gsv::gateway::transport
