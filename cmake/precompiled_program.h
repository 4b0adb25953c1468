// Compiled once for all programs but tests (cmake/GsvTargets.cmake); a file still includes what it
// uses.
#pragma once

#include <CLI/CLI.hpp>

#include "precompiled_library.h"
