#include "gsv/broker/language/value.h"

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

TEST(Value, HoldsTextsOfEveryLength) {
  for (std::size_t length = 0; length < 40; ++length) {
    const std::string text(length, 'x');
    const Value value = Value::String(text);
    const Value copy = value;
    EXPECT_EQ(copy.AsText(), text);
    EXPECT_EQ(copy, value);
    EXPECT_FALSE(copy == Value::String(text + "y"));
    EXPECT_EQ(copy.AsInteger(), std::nullopt);
    EXPECT_EQ(copy.AsSequence(), nullptr);
  }
}

TEST(Value, CopyStaysValidAfterItsOriginalIsDestroyed) {
  Value copy = Value::Long(1);
  {
    const Value sequence = Value::Strings({"a text that is not short", "b"});
    copy = sequence;
  }
  ASSERT_NE(copy.AsSequence(), nullptr);
  EXPECT_EQ(std::get<std::string>(copy.AsSequence()->front()), "a text that is not short");
  const Value moved = std::move(copy);
  copy = moved;
  EXPECT_EQ(copy, moved);
  copy = Value::Other({"octet", "x"});
  EXPECT_EQ(copy.AsOther()->type_name, "octet");
  EXPECT_EQ(moved.AsSequence()->size(), 2u);
}

TEST(Value, DiffersFromValuesOfOtherTypes) {
  EXPECT_FALSE(Value::Long(1) == Value::Short(1));
  EXPECT_FALSE(Value::String("a") == Value::Strings({"a"}));
  EXPECT_FALSE(Value::Boolean(true) == Value::Long(1));
  EXPECT_EQ(Value::Double(0.5), Value::Double(0.5));
}

}  // namespace
}  // namespace gsv::broker
