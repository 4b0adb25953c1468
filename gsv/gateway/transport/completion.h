// A Completion is a type-erased completion handler of Boost.Asio. If all operations of one kind get
// a Completion, the kind is compiled once instead of once for each lambda.
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
  // `then` is called with the error and the number of bytes, or with the error only, or without
  // arguments.
  template <typename Then>
  // NOLINTNEXTLINE(bugprone-forwarding-reference-overload)
  requires(!std::is_same_v<std::remove_cvref_t<Then>, Completion>) explicit Completion(Then&& then)
      : then_(new std::remove_cvref_t<Then>(std::forward<Then>(then))),
        end_(&End<std::remove_cvref_t<Then>>) {}
  Completion(Completion&& other) noexcept
      : then_(std::exchange(other.then_, nullptr)), end_(other.end_) {}
  Completion& operator=(Completion&& other) noexcept {
    std::swap(then_, other.then_);
    std::swap(end_, other.end_);
    return *this;
  }
  ~Completion() {
    if (then_ != nullptr) end_(then_, nullptr);
  }

  void operator()(boost::system::error_code error = {}, std::size_t bytes = 0) {
    const Result result{error, bytes};
    end_(std::exchange(then_, nullptr), &result);
  }

 private:
  struct Result {
    boost::system::error_code error;
    std::size_t bytes;
  };

  // Calls the handler if there is a result, and destroys it. This is one function, and not a
  // class with virtual functions, because it is compiled for each handler.
  template <typename Then>
  static void End(void* handler, const Result* result) {
    const std::unique_ptr<Then> then(static_cast<Then*>(handler));
    if (result == nullptr) return;
    if constexpr (std::is_invocable_v<Then&, boost::system::error_code, std::size_t>) {
      (*then)(result->error, result->bytes);
    } else if constexpr (std::is_invocable_v<Then&, boost::system::error_code>) {
      (*then)(result->error);
    } else {
      (*then)();
    }
  }

  void* then_;  // the handler; null after the call
  void (*end_)(void* then, const Result* result);
};

}  // namespace gsv::gateway::transport
