#include "gsv/base/result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::base {
namespace {

Result<std::string> Text(bool has_one) {
  if (!has_one) return Fail(ErrorCode::kNotFound, "there is no text", "a file");
  return "a text that is too long for the string itself";
}

TEST(Result, HasAValueOrAnError) {
  const Result<std::string> text = Text(true), none = Text(false);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "a text that is too long for the string itself");
  EXPECT_EQ(text->size(), 45u);
  EXPECT_EQ(text.value_or("other"), *text);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().Sentence(), "a file: there is no text");
  EXPECT_EQ(none.value_or("other"), "other");
  EXPECT_EQ(text.value(), *text);
  EXPECT_THROW((void)none.value(), std::logic_error);
}

TEST(Result, IsAssignedBetweenValuesAndErrors) {
  Result<std::string> result = Text(true);
  result = Text(false);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "there is no text");
  result = "again";
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, "again");
  const Result<std::string> copy = result;
  result = *std::move(result) + " and again";
  EXPECT_EQ(*result, "again and again");
  EXPECT_EQ(*copy, "again");
  Result<std::string>& same = result;
  result = same;
  EXPECT_EQ(*result, "again and again");
}

// A value that counts its instances.
struct Counting {
  explicit Counting(int& counter) : count(counter) { ++count; }
  Counting(const Counting& other) : count(other.count) { ++count; }
  ~Counting() { --count; }
  Counting& operator=(const Counting&) = delete;
  int& count;
};

TEST(Result, DestroysEachValueOnce) {
  int count = 0;
  {
    Result<Counting> result = Counting(count);
    EXPECT_EQ(count, 1);
    const Result<Counting> copy = result;
    EXPECT_EQ(count, 2);
    result = Fail(ErrorCode::kEnded, "no more");
    EXPECT_EQ(count, 1);
    result = copy;
    EXPECT_EQ(count, 2);
    std::vector<Result<Counting>> several(3, copy);
    EXPECT_EQ(count, 5);
  }
  EXPECT_EQ(count, 0);
}

TEST(Result, MovesWhatCannotBeCopiedAndConvertsPointers) {
  struct Base {
    virtual ~Base() = default;
  };
  struct Derived : Base {};
  const auto make = []() -> Result<std::unique_ptr<Base>> { return std::make_unique<Derived>(); };
  Result<std::unique_ptr<Base>> made = make();
  ASSERT_TRUE(made);
  const std::unique_ptr<Base> base = *std::move(made);
  EXPECT_NE(dynamic_cast<const Derived*>(base.get()), nullptr);
  static_assert(!std::is_copy_constructible_v<Result<std::unique_ptr<Base>>>);
  static_assert(std::is_copy_constructible_v<Result<std::string>>);
  static_assert(!std::is_convertible_v<Result<std::string>, bool>);
}

TEST(Result, OfVoidIsSuccessByDefault) {
  Status status;
  EXPECT_TRUE(status);
  status = Fail(ErrorCode::kTimeout, "too late");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kTimeout);
  EXPECT_THROW(status.value(), std::logic_error);
}

TEST(Result, HasOtherErrorsToo) {
  const ResultOf<int, std::string> none = Failure{std::string("no number")}, one = 1;
  EXPECT_EQ(none.error(), "no number");
  EXPECT_EQ(*one, 1);
}

}  // namespace
}  // namespace gsv::base
