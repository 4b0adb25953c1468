#include "gsv/base/late_library.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <map>
#include <string>

#include "gsv/base/mutex.h"

namespace gsv::base {
namespace {

constexpr int kCannotLoad = 127;

[[noreturn]] void EndWithoutLibrary(const char* file) {
  const char* reason = dlerror();
  std::fprintf(stderr, "gsv: cannot load %s: %s\n", file, reason == nullptr ? "unknown" : reason);
  std::fflush(nullptr);
  _exit(kCannotLoad);
}

void* LateLibrary(const char* file) {
  static Mutex mutex;
  static std::map<std::string, void*> libraries;
  const MutexLock lock(mutex);
  void*& library = libraries[file];
  if (library == nullptr) library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) EndWithoutLibrary(file);
  return library;
}

}  // namespace
}  // namespace gsv::base

void* gsv_late_function(const char* file, const char* name) noexcept {
  void* function = dlsym(gsv::base::LateLibrary(file), name);
  if (function == nullptr) gsv::base::EndWithoutLibrary(file);
  return function;
}
