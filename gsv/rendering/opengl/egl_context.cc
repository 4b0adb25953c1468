#include "gsv/rendering/opengl/egl_context.h"

#include <dlfcn.h>
#include <link.h>

#include <string_view>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "gsv/base/sanitizer.h"
#include "gsv/rendering/opengl/gl.h"

namespace gsv::rendering {
namespace {

using base::ErrorCode;
using base::Fail;
using base::Result;
using base::Status;

constexpr const char* kRemedy =
    "images need OpenGL 4.5 through EGL: install libegl1, libopengl0 and libgl1-mesa-dri, or "
    "your graphics card's driver";

// Checks whether a library can be opened. If it cannot, the first call of one of its functions would
// end the program (gsv_late_library()).
Status CheckLibrary(const std::string& name) {
  void* handle = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) {
    return Fail(ErrorCode::kUnavailable, name + " cannot be opened; " + kRemedy);
  }
  dlclose(handle);
  return {};
}

// Keeps the driver's library loaded. Mesa would unload its drivers at exit, before LeakSanitizer
// searches for leaks. LeakSanitizer would then not know which allocations are a driver's, and would
// report them although cmake/sanitizers/lsan.supp suppresses them.
int KeepDriver(dl_phdr_info* object, std::size_t, void*) {
  const std::string name = object->dlpi_name;
  if (name.ends_with("_dri.so")) dlopen(name.c_str(), RTLD_NOW | RTLD_NODELETE);
  return 0;
}

bool Has(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  std::string_view rest(extensions);
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    if (rest.substr(0, space) == name) return true;
    rest = space == std::string_view::npos ? std::string_view() : rest.substr(space + 1);
  }
  return false;
}

// Returns a function of an extension; null if EGL does not have it.
template <typename Function>
Function FunctionOf(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// Returns EGL_NO_DISPLAY if EGL does not know the platform.
EGLDisplay DisplayOf(EGLenum platform, void* native) {
  const auto get = FunctionOf<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return get == nullptr ? EGL_NO_DISPLAY : get(platform, native, nullptr);
}

std::vector<EGLDisplay> DeviceDisplays(const char* client_extensions) {
  std::vector<EGLDisplay> displays;
  if (!ListsDevices(client_extensions)) return displays;
  const auto devices_of = FunctionOf<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto text_of = FunctionOf<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  EGLDeviceEXT devices[16];
  EGLint count = 0;
  if (devices_of == nullptr || text_of == nullptr || !devices_of(16, devices, &count)) {
    return displays;
  }
  for (EGLint i = 0; i < count; ++i) {
    const bool is_software = Has(text_of(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
    if (!is_software) displays.push_back(DisplayOf(EGL_PLATFORM_DEVICE_EXT, devices[i]));
  }
  return displays;
}

// Returns the displays in the order in which they are tried: graphics cards, then Mesa without a
// device.
std::vector<EGLDisplay> Displays(const EglOptions& options) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EGLDisplay> displays;
  if (options.hardware) displays = DeviceDisplays(extensions);
  if (options.software && Has(extensions, "EGL_MESA_platform_surfaceless")) {
    displays.push_back(DisplayOf(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY));
  }
  return displays;
}

// Makes a current context on `display`. Returns null if that fails.
EGLContext MakeCurrentOn(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return nullptr;
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  if (Has(extensions, "EGL_KHR_no_config_context") &&
      Has(extensions, "EGL_KHR_surfaceless_context") && eglBindAPI(EGL_OPENGL_API)) {
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context != EGL_NO_CONTEXT &&
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      return context;
    }
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }
  return nullptr;
}

// Whether the renderer is Mesa's software renderer. Mesa also uses this renderer if there is a card
// that cannot be used.
bool IsMesaInSoftware(const std::string& renderer_name) {
  return renderer_name.starts_with("llvmpipe") || renderer_name.starts_with("softpipe");
}

std::string GlText(unsigned name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

}  // namespace

// EGL_EXT_device_base is the older name of device_enumeration and device_query together. NVIDIA's
// driver reports only this name if it is the only driver.
bool ListsDevices(const char* client_extensions) {
  const bool enumerates = Has(client_extensions, "EGL_EXT_device_base") ||
                          (Has(client_extensions, "EGL_EXT_device_enumeration") &&
                           Has(client_extensions, "EGL_EXT_device_query"));
  return enumerates && Has(client_extensions, "EGL_EXT_platform_device");
}

Result<std::unique_ptr<EglContext>> EglContext::Create(const EglOptions& options) {
  for (const std::string& library : {options.egl_library, options.gl_library}) {
    if (Status status = CheckLibrary(library); !status) return Fail(status.error());
  }
  const std::vector<EGLDisplay> displays = Displays(options);
  for (EGLDisplay display : displays) {
    EGLContext context = MakeCurrentOn(display);
    if (context == nullptr) continue;
    std::string name = GlText(GL_RENDERER) + ", OpenGL " + GlText(GL_VERSION);
    if constexpr (base::kHasAddressSanitizer) dl_iterate_phdr(KeepDriver, nullptr);
    std::unique_ptr<EglContext> created(new EglContext(display, context, std::move(name)));
    if (options.software || !IsMesaInSoftware(created->renderer_name())) return created;
  }
  return Fail(ErrorCode::kUnavailable,
              std::string(displays.empty() ? "EGL found neither a graphics device nor Mesa"
                                           : "EGL gave no OpenGL 4.5 core context") +
                  "; " + kRemedy);
}

// The display is not terminated, because it belongs to the process, and other contexts may use it.
EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglReleaseThread();
}

}  // namespace gsv::rendering
