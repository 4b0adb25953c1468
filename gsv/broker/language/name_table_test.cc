#include "gsv/broker/language/name_table.h"

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

TEST(NameTable, ListsWithTheSameNamesShareThem) {
  NameTable table;
  PropertyList a = WithNames({"speed", "name"});
  PropertyList b = WithNames({"name", "speed"});
  PropertyList c = WithNames({"name"});
  for (PropertyList* list : {&a, &b, &c}) table.Share(*list);
  EXPECT_EQ(a.names(), b.names());
  EXPECT_NE(a.names(), c.names());
  EXPECT_EQ(*c.names(), PropertyNames{"name"});
}

TEST(NameTable, ChangedListLeavesTheOthersUnchanged) {
  NameTable table;
  PropertyList a = WithNames({"speed", "name"});
  PropertyList b = a;
  table.Share(a);
  table.Share(b);
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

TEST(NameTable, RemovesUnusedNames) {
  NameTable table;
  PropertyList kept = WithNames({"kept"});
  table.Share(kept);
  for (int i = 0; i < 10'000; ++i) {
    PropertyList other = WithNames({"p" + std::to_string(i)});
    table.Share(other);
  }
  EXPECT_LE(table.size(), 100u);
  PropertyList again = WithNames({"kept"});
  table.Share(again);
  EXPECT_EQ(again.names(), kept.names());
}

}  // namespace
}  // namespace gsv::broker
