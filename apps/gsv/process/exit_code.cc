#include "apps/gsv/process/exit_code.h"

#include <cstdio>

namespace gsv::app {

ExitCode ExitCodeFor(base::ErrorCode code) {
  switch (code) {
    case base::ErrorCode::kInvalidArgument:
      return kUsage;
    case base::ErrorCode::kBadModel:
    case base::ErrorCode::kNotFound:
      return kBadModel;
    case base::ErrorCode::kBehaviour:
      return kBehaviourFailed;
    default:
      return kInfrastructure;
  }
}

int PrintError(const base::Error& error) {
  std::fprintf(stderr, "gsv: %s\n", error.Sentence().c_str());
  return ExitCodeFor(error.code);
}

}  // namespace gsv::app
