// The headers that are precompiled once for all tests (cmake/GsvTargets.cmake). Each source file
// still includes what it uses.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "precompiled_library.h"
