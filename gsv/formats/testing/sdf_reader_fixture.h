// A fixture for tests of the reader: a folder for their files, and the problems that were reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {

// Returns an SDFormat document with this content.
inline std::string Sdf(const std::string& content, const std::string& version = "1.9") {
  return "<?xml version='1.0'?>\n<sdf version='" + version + "'>\n" + content + "\n</sdf>\n";
}

inline void ExpectNear(const geometry::Vector3& actual, const geometry::Vector3& expected) {
  EXPECT_NEAR(actual.x, expected.x, 1e-9);
  EXPECT_NEAR(actual.y, expected.y, 1e-9);
  EXPECT_NEAR(actual.z, expected.z, 1e-9);
}

class SdfReaderTest : public testing::Test {
 protected:
  // Reads an SDFormat document with this content as a world. The test fails if it cannot be read.
  model::WorldDescription World(const std::string& content, const std::string& version = "1.9") {
    auto world = ModelLibrary().ReadWorld(folder_.Write("w.sdf", Sdf(content, version)), problems_);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }
  // Like World(), for a model.
  std::shared_ptr<const model::Model> Model(const std::string& content) {
    auto model = ModelLibrary().ReadModel(folder_.Write("m.sdf", Sdf(content)).string(), problems_);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().Sentence());
    return model.value_or(std::make_shared<const model::Model>());
  }
  // Returns the problems so far as sentences.
  std::vector<std::string> Sentences() const {
    std::vector<std::string> sentences;
    for (const auto& problem : problems_) sentences.push_back(problem.Sentence());
    return sentences;
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

}  // namespace gsv::formats
