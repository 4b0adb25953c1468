// Reads the arguments of a command: checks them against its parameters, and adds default values.
//
// Errors  kInvalidArgument, one sentence that names the command and the parameter: an unknown or
//         missing argument, a wrong type, a number out of range, NaN.
#pragma once

#include <map>
#include <string>

#include "gsv/base/error.h"
#include "gsv/simulation/commands/command.h"

namespace gsv::simulation {

// A value without fraction is accepted for integers and numbers, as either alternative.
base::Result<Arguments> ReadArguments(const Command& command, Arguments::Values given);

// The same for texts, each parsed as its parameter's type: "-1.62", "true", "7".
base::Result<Arguments> ReadArguments(const Command& command,
                                      const std::map<std::string, std::string>& given);

// The valid values as a text: "a number from -100 to 100 m/s²", "true or false".
std::string DescribeRange(const Parameter& parameter);

}  // namespace gsv::simulation
