// The output of `gsv test`.
#pragma once

#include <string>
#include <vector>

#include "apps/gsv/trials/test_cases.h"

namespace gsv::app {

// Returns one line, and for a failure also the reason and the folder with the files of the failure.
std::string ToText(const TestResult& result);

// Returns JUnit's XML for Jenkins and GitLab. It has one <testcase> per scenario, <failure> for
// failed tests, <error> for runs without a result, and <skipped> for interrupted runs.
std::string ToJUnit(const std::vector<TestResult>& results, double wall_seconds);

// Returns {passed, failed, errors, wall_s, results: [{scenario, file, status, message, folder,
// command, wall_s, state_hashes, report}]}. `report` is the output of `gsv run --json`.
std::string ToJson(const std::vector<TestResult>& results, double wall_seconds);

std::size_t Count(const std::vector<TestResult>& results, TestResult::Status status);

}  // namespace gsv::app
