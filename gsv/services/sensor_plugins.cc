#include "gsv/services/sensor_plugins.h"

#include <dlfcn.h>

#include <algorithm>

#include "gsv/base/sorting.h"
#include "gsv/sensing/module.h"

namespace gsv::services {

std::vector<std::filesystem::path> FindSensorPlugins(std::string_view folders) {
  std::vector<std::filesystem::path> found;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    std::vector<std::filesystem::path> here;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folders.substr(0, end), ignored)) {
      const std::string name = entry.path().filename();
      if (name.starts_with("gsv-sensor-") && name.ends_with(".so")) here.push_back(entry.path());
    }
    base::Sort(here);
    found.insert(found.end(), here.begin(), here.end());
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return found;
}

base::Status LoadSensorPlugin(const std::filesystem::path& file,
                              sensing::SensorRegistry& registry) {
  // The path must be absolute, because dlopen would search a bare name in the system's folders.
  void* const library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      std::string("cannot be loaded as a sensor plug-in: ") + dlerror(), file);
  }
  const auto module = reinterpret_cast<const sensing::SensorModule* (*)()>(
      dlsym(library, sensing::kSensorModuleSymbol));
  if (module == nullptr) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "is not a sensor plug-in: it lacks GSV_SENSOR_MODULE, see gsv/sensing/module.h", file);
  }
  const sensing::SensorModule* const found = module();
  if (found == nullptr || found->add == nullptr ||
      found->interface_version != sensing::kSensorInterface) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "was built against another version of gsv; build it again", file);
  }
  if (auto added = found->add(registry); !added) {
    return base::Fail(added.error().code, added.error().Sentence(), file);
  }
  return {};
}

}  // namespace gsv::services
