#include "gsv/broker/language/property.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

PropertyList WithNames(const std::vector<std::string>& names) {
  PropertyList list;
  for (const std::string& name : names) list.Set({name, Value::Long(1)});
  return list;
}

TEST(PropertyList, ListsWithEqualNamesShareOneListOfNames) {
  PropertyList a = WithNames({"speed", "name"});
  PropertyList b = WithNames({"name", "speed"});
  PropertyList c = WithNames({"name"});
  EXPECT_EQ(&*a.names(), &*b.names());
  EXPECT_NE(&*a.names(), &*c.names());
  EXPECT_EQ(*c.names(), PropertyNames{"name"});
}

TEST(PropertyList, ChangedListLeavesTheOthersUnchanged) {
  PropertyList a = WithNames({"speed", "name"});
  PropertyList b = a;
  b.Set({"floor", Value::Short(2)});
  EXPECT_TRUE(b.Remove("name"));
  EXPECT_EQ(*a.names(), (PropertyNames{"name", "speed"}));
  EXPECT_EQ(*b.names(), (PropertyNames{"floor", "speed"}));
  EXPECT_EQ(*b.Find("speed"), Value::Long(1));
  EXPECT_EQ(*b.Find("floor"), Value::Short(2));
}

TEST(PropertyList, LastValueOfANameApplies) {
  const PropertyList list = PropertyList::LastOfEachName(
      {{"b", Value::Long(1)}, {"a", Value::Long(2)}, {"b", Value::Long(3)}});
  EXPECT_EQ(*list.names(), (PropertyNames{"a", "b"}));
  EXPECT_EQ(*list.Find("b"), Value::Long(3));
}

}  // namespace
}  // namespace gsv::broker
