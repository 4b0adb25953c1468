// The functions of CLI11's classes, see CLI/CLI.hpp.
#ifndef __clang__
#pragma implementation "App.hpp"
#pragma implementation "Config.hpp"
#pragma implementation "ConfigFwd.hpp"
#pragma implementation "Error.hpp"
#pragma implementation "Formatter.hpp"
#pragma implementation "FormatterFwd.hpp"
#pragma implementation "Option.hpp"
#pragma implementation "Split.hpp"
#pragma implementation "StringTools.hpp"
#pragma implementation "Validators.hpp"
#endif

#include <CLI/CLI.hpp>
