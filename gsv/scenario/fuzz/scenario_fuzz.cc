// Fuzz target: reads the input as a scenario. The reader must not crash. If a scenario without
// problems is written and read again, it must be unchanged.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "gsv/scenario/scenario_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gsv;
  base::Problems problems;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto scenario = scenario::ParseScenario(text, "fuzz.yaml", problems);
  if (!scenario || !problems.empty()) return 0;
  const auto again = scenario::ParseScenario(scenario::ToYaml(*scenario), "again.yaml", problems);
  if (!again || !problems.empty() || *again != *scenario) std::abort();
  return 0;
}
