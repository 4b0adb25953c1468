// Reads the arguments of a command: checks them against its parameters, and adds default values.
//
// Errors  kInvalidArgument with one sentence that names the command and the parameter. The reasons
//         are an unknown or missing argument, a wrong type, a number out of range, and NaN.
#pragma once

#include <map>
#include <string>

#include "gsv/base/error.h"
#include "gsv/simulation/commands/command.h"

namespace gsv::simulation {

// Checks typed values. A value without a fraction is accepted for integer and for number
// parameters.
base::Result<Arguments> ReadArguments(const Command& command, Arguments::Values given);

// Checks texts such as "-1.62", "true" and "7". Each is parsed as the type of its parameter.
base::Result<Arguments> ReadArguments(const Command& command,
                                      const std::map<std::string, std::string>& given);

// Returns the valid values as a text, such as "a number from -100 to 100 m/s²" or "true or false".
std::string DescribeRange(const Parameter& parameter);

}  // namespace gsv::simulation
