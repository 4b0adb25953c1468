#include "gsv/ros2/dds/module.h"

#include <dlfcn.h>

#include <filesystem>

namespace gsv::ros2::dds {
namespace {

base::Result<const Module*> LoadFrom(const std::string& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      std::string("cannot load the plug-in for ROS 2: ") + dlerror(), file);
  }
  const auto symbol = reinterpret_cast<const Module* (*)()>(dlsym(library, kModuleSymbol));
  const Module* const module = symbol == nullptr ? nullptr : symbol();
  if (module == nullptr || module->interface_version != kModuleInterface) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "the plug-in for ROS 2 belongs to another version of gsv. Install both from "
                      "one build",
                      file);
  }
  return module;
}

}  // namespace

base::Result<std::string> FindModule(const std::vector<std::string>& folders) {
  std::string looked_in;
  for (const std::string& folder : folders) {
    const std::filesystem::path file = std::filesystem::path(folder) / kModuleFile;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file.string();
    looked_in += (looked_in.empty() ? "" : ", ") + folder;
  }
  return base::Fail(base::ErrorCode::kUnavailable,
                    std::string("this gsv was built without ROS 2: there is no ") + kModuleFile +
                        " in " + looked_in + ". Build with -DGSV_ROS2=ON");
}

base::Result<const Module*> LoadModule(const std::vector<std::string>& folders) {
  const auto file = FindModule(folders);
  return file ? LoadFrom(*file) : base::Fail(file.error());
}

}  // namespace gsv::ros2::dds
