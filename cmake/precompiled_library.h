// The headers that are precompiled once for all libraries (cmake/GsvTargets.cmake). Each source
// file still includes what it uses.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#ifndef __OPTIMIZE__
// GCC 12 does not undo fmt's pragma of -Og when it loads a precompiled header, and then takes
// functions of <emmintrin.h> that need optimisation.
#define FMT_GCC_PRAGMA(arg)
#endif
#include <fmt/format.h>

#include "gsv/base/json_templates.h"  // includes <nlohmann/json.hpp>, and must be the first to do so
