#include "apps/gsv/process/option_values.h"

#include <string>

#include <gtest/gtest.h>

namespace gsv::app {
namespace {

std::string ErrorFor(const std::string& value) {
  CLI::App app;
  std::string scene;
  app.add_option("--scene", scene)->check(OneOf({"rovers", "boxes", "arms"}));
  try {
    app.parse("--scene " + value);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return scene == value ? "" : "not stored";
}

TEST(OneOf, AcceptsItsWordsOnly) {
  EXPECT_EQ(ErrorFor("boxes"), "");
  EXPECT_EQ(ErrorFor("heap"), "--scene: expected rovers, boxes or arms, found heap");
}

TEST(OneOf, SuggestsTheWordForAMisspeltOne) {
  EXPECT_EQ(ErrorFor("rover"),
            "--scene: expected rovers, boxes or arms, found rover. Did you mean rovers?");
}

}  // namespace
}  // namespace gsv::app
