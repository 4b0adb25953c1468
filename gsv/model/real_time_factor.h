// The limit of real-time factors. World files, scenarios and running simulations have the same limit.
#pragma once

namespace gsv::model {

// Maximum real-time factor: simulated time divided by wall-clock time.
inline constexpr double kMaxRealTimeFactor = 1e6;

}  // namespace gsv::model
