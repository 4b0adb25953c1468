// Makes GCC compile the functions of CLI11's classes once, in cli11.cc, and not again in each file that
// includes <CLI/CLI.hpp>, where they took 5.9 s. In these files, GCC can still inline them. The library
// gsv_cli11 puts this folder before that of CLI11.
//
// `#pragma interface` applies to the file that contains it, so `#line` gives it the name of each of
// CLI11's headers. If CLI11 is elsewhere, or with clang, each file compiles the functions as before.
#ifdef __clang__
#include_next <CLI/CLI.hpp>
#else
#line 1 "/usr/include/CLI/App.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Config.hpp"
#pragma interface
#line 1 "/usr/include/CLI/ConfigFwd.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Error.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Formatter.hpp"
#pragma interface
#line 1 "/usr/include/CLI/FormatterFwd.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Option.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Split.hpp"
#pragma interface
#line 1 "/usr/include/CLI/StringTools.hpp"
#pragma interface
#line 1 "/usr/include/CLI/Validators.hpp"
#pragma interface
#line 37 "CLI.hpp"
#include_next <CLI/CLI.hpp>
#endif
