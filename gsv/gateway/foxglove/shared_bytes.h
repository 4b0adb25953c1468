// SharedBytes holds immutable bytes, which copies of the object share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gsv::gateway {

// Immutable bytes that copies of the object share.
class SharedBytes {
 public:
  SharedBytes() = default;
  explicit SharedBytes(std::string bytes) { Own(std::move(bytes)); }
  explicit SharedBytes(std::vector<std::byte> bytes) { Own(std::move(bytes)); }
  explicit SharedBytes(std::vector<std::uint8_t> bytes) { Own(std::move(bytes)); }

  // Valid during the lifetime of any copy of this object.
  std::string_view view() const { return view_; }
  std::size_t size() const { return view_.size(); }
  const char* data() const { return view_.data(); }

 private:
  // Takes ownership of the bytes.
  template <typename Container>
  void Own(Container bytes) {
    auto owner = std::make_shared<const Container>(std::move(bytes));
    view_ = {reinterpret_cast<const char*>(owner->data()), owner->size()};
    owner_ = std::move(owner);
  }

  std::shared_ptr<const void> owner_;
  std::string_view view_;
};

}  // namespace gsv::gateway
