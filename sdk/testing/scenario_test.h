// Support for GoogleTest: scenarios as tests (docs/testing.md), and a simulator for a test program.
//
// ExpectPasses() and SimulatorTest start the program gsv. Its path is in GSV_PROGRAM; otherwise it
// is searched on the PATH.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/application.h"

namespace gsv::testing {

// Runs `gsv test FILE` and fails the current test with its output if it does not pass. `options`
// are passed to `gsv test`.
void ExpectPasses(const std::string& scenario, const std::vector<std::string>& options = {});

// A simulator with its own broker and ports, which the tests of a program share.
class SimulatorTest : public ::testing::Test {
 protected:
  void SetUp() override;

  static Application& simulator();
  static const std::string& broker();  // The reference of the broker, for behaviours.
};

}  // namespace gsv::testing
