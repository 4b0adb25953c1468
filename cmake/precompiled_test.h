// Compiled once for all tests (cmake/GsvTargets.cmake). A file still includes what it uses.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "precompiled_library.h"
