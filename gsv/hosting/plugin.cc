#include "gsv/hosting/plugin.h"

#include <dlfcn.h>

#include <filesystem>

namespace gsv::hosting {

std::string FindPlugin(const std::string& behaviour, const std::vector<std::string>& folders) {
  if (behaviour.find('/') != std::string::npos) return {};
  for (const std::string& folder : folders) {
    const std::filesystem::path file = std::filesystem::path(folder) / ("gsv-" + behaviour + ".so");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return {};
}

base::Result<const BehaviourModule*> LoadPlugin(const std::string& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return base::Fail(base::ErrorCode::kBehaviour,
                      std::string("cannot be loaded as a plug-in: ") + dlerror(), file);
  }
  const auto module =
      reinterpret_cast<const BehaviourModule* (*)()>(dlsym(library, kBehaviourModuleSymbol));
  if (module == nullptr) {
    return base::Fail(base::ErrorCode::kBehaviour,
                      "is not a behaviour: it lacks GSV_BEHAVIOUR, see sdk/behaviour/module.h",
                      file);
  }
  const BehaviourModule* const found = module();
  if (found == nullptr || found->interface_version != kBehaviourInterface) {
    return base::Fail(base::ErrorCode::kBehaviour,
                      "was built against another version of gsv; build it again", file);
  }
  return found;
}

}  // namespace gsv::hosting
