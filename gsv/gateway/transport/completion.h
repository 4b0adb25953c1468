// A Completion is a type-erased completion handler of Boost.Asio for reads and writes.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include <boost/system/error_code.hpp>

namespace gsv::gateway::transport {

// A completion handler of any type. It must be called at most once, and can be moved, but not
// copied. The executor and the allocator that are associated with the handler are ignored.
class Completion {
 public:
  // `then` is called with the error and the number of bytes, or with the error only.
  template <typename Then>
  // NOLINTNEXTLINE(bugprone-forwarding-reference-overload)
  requires(!std::is_same_v<std::remove_cvref_t<Then>, Completion>) explicit Completion(Then&& then)
      : step_(std::make_unique<Step<std::remove_cvref_t<Then>>>(std::forward<Then>(then))) {}

  void operator()(boost::system::error_code error, std::size_t bytes = 0) {
    // The state of the operation is destroyed before the next operation begins, as in Boost.Asio.
    std::exchange(step_, nullptr)->Take(error, bytes);
  }

 private:
  // The type-erased handler.
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
    Then then;  // the handler
  };

  std::unique_ptr<AnyStep> step_;  // null after the call
};

}  // namespace gsv::gateway::transport
