// Represents expected failures as values: a code, a message and a location.
//
// A message says what was expected, what was found and what to do. `where` names the affected
// file (and line), element path or address. An error is either returned or logged, never
// both.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gsv/base/result.h"

namespace gsv::base {

// Each code corresponds to one reaction of the caller. The command line maps codes to exit codes.
enum class ErrorCode {
  kInvalidArgument,  // a request that cannot succeed without a change (exit code 2)
  kBadModel,         // a world, robot, mesh or texture that cannot be used (3)
  kBehaviour,        // a behaviour that threw, crashed or hung (4)
  kNotFound,         // a name, file or offer that does not exist (3; commands for recordings: 5)
  kUnavailable,      // a peer, port, display or disk that does not answer (5)
  kTimeout,          // an operation that took longer than its time limit (5)
  kNotRunning,       // a call that is not allowed in the current state (5)
  kEnded,            // the simulation or the server has ended (5)
  kCorrupt,          // bytes that cannot be decoded (5)
};

struct Error {
  ErrorCode code = ErrorCode::kInvalidArgument;
  std::string message;
  std::string where;  // such as a file with its line, or an address; may be empty

  // Returns "where: message", or the message alone if `where` is empty.
  std::string Sentence() const { return where.empty() ? message : where + ": " + message; }
};

template <typename T>
using Result = ResultOf<T, Error>;

using Status = Result<void>;

inline Failure<Error> Fail(ErrorCode code, std::string message, std::string where = {}) {
  return {{code, std::move(message), std::move(where)}};
}

inline Failure<Error> Fail(Error error) { return {std::move(error)}; }

// A problem that was found while a file was read. Readers collect all problems before they return.
struct Problem {
  enum class Severity { kWarning, kError };
  Severity severity = Severity::kWarning;
  std::string message;
  std::string where;  // such as a file with its line, or an address; may be empty

  std::string Sentence() const { return where.empty() ? message : where + ": " + message; }
};

using Problems = std::vector<Problem>;

}  // namespace gsv::base
