#include "gsv/sensing/rays/candidate_set.h"

namespace gsv::sensing {

void CandidateSet::Begin(const geometry::Vector3& place, double reach) {
  place_ = place;
  reach_ = reach;
  count_ = 0;
  is_overfull_ = false;
}

bool CandidateSet::Finish() {
  for (std::size_t i = count_; i % 4 != 0; ++i) {
    x_[i] = y_[i] = z_[i] = 0;
    squared_radius_[i] = -1;
  }
  return !is_overfull_;
}

}  // namespace gsv::sensing
