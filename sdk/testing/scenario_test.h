// For tests in GoogleTest: scenarios as tests (docs/testing.md), and a simulator of one's own.
//
// Both start the program gsv: that of the environment variable GSV_PROGRAM, else the one on PATH.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/application.h"

namespace gsv::testing {

// Runs `gsv test FILE` and fails the present test with its words where it does not pass. `options`:
// further ones of `gsv test`.
void ExpectPasses(const std::string& scenario, const std::vector<std::string>& options = {});

// A simulator with a broker and ports of its own, which the tests of a program share.
class SimulatorTest : public ::testing::Test {
 protected:
  void SetUp() override;

  static Application& simulator();
  static const std::string& broker();  // its reference, for behaviours
};

}  // namespace gsv::testing
