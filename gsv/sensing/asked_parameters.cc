#include "gsv/sensing/asked_parameters.h"

namespace gsv::sensing {
namespace {

thread_local AskedParameters* innermost = nullptr;

}  // namespace

AskedParameters::AskedParameters() : outer_(innermost) { innermost = this; }

AskedParameters::~AskedParameters() { innermost = outer_; }

void AskedParameters::Add(const std::string& name) {
  if (innermost != nullptr) innermost->names_.insert(name);
}

}  // namespace gsv::sensing
