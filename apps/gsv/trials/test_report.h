// What `gsv test` says of its results.
#pragma once

#include <string>
#include <vector>

#include "apps/gsv/trials/test_cases.h"

namespace gsv::app {

// One line, and for a failure what is wrong and where to look.
std::string ToText(const TestResult& result);

// JUnit's XML as Jenkins and GitLab read it: one <testcase> a scenario, <failure> for what was
// expected and did not come, <error> for what could not be found out.
std::string ToJUnit(const std::vector<TestResult>& results, double wall_seconds);

// {passed, failed, errors, wall_s, results: [{scenario, file, status, message, folder, command,
// wall_s, state_hashes, report}]}; `report` is what `gsv run --json` says.
std::string ToJson(const std::vector<TestResult>& results, double wall_seconds);

std::size_t Count(const std::vector<TestResult>& results, TestResult::Status status);

}  // namespace gsv::app
