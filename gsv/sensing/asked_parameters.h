// The names of the parameters that a sensor type has. They are found by creating a sensor of this
// type.
#pragma once

#include <set>
#include <string>

namespace gsv::sensing {

// Collects the names of all parameters that ParameterReaders of this thread read while this object
// exists. Objects may be nested; a name is added only to the innermost object.
//
// Threads  use it on the thread that created it.
class AskedParameters {
 public:
  AskedParameters();
  ~AskedParameters();
  AskedParameters(const AskedParameters&) = delete;
  AskedParameters& operator=(const AskedParameters&) = delete;

  const std::set<std::string>& names() const { return names_; }

  // Adds the name to the collection of this thread, if there is one.
  static void Add(const std::string& name);

 private:
  std::set<std::string> names_;
  AskedParameters* const outer_;  // the object in which this one is nested; null if there is none
};

}  // namespace gsv::sensing
