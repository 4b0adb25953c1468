// An OpenGL 4.5 core context without a window, a display server or a screen. It uses EGL on a
// graphics device, or Mesa's software renderer, which needs no device.
//
// Errors   kUnavailable with the missing part and its package.
// Threads  created, used and destroyed on one thread, where it stays current.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"

namespace gsv::rendering {

// The devices and libraries that may be used.
struct EglOptions {
  // Whether to use a graphics card, and whether to use Mesa's software renderer. The card is tried
  // first.
  bool hardware = true;
  bool software = true;
  // The names of the libraries to open.
  std::string egl_library = "libEGL.so.1";
  std::string gl_library = "libOpenGL.so.0";
};

// Whether EGL can list graphics devices, according to its client extensions: EGL_EXT_device_base
// (or EGL_EXT_device_enumeration and EGL_EXT_device_query), and EGL_EXT_platform_device. Null
// stands for no extensions.
bool ListsDevices(const char* client_extensions);

// An OpenGL context without a window.
class EglContext {
 public:
  // Creates a context and makes it current on the calling thread.
  static base::Result<std::unique_ptr<EglContext>> Create(const EglOptions& options);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  // The name of the OpenGL renderer, such as "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core
  // Profile) Mesa 22.3.6".
  const std::string& renderer_name() const { return renderer_name_; }

 private:
  EglContext(void* display, void* context, std::string renderer_name)
      : display_(display), context_(context), renderer_name_(std::move(renderer_name)) {}

  void* display_;  // EGLDisplay
  void* context_;  // EGLContext
  std::string renderer_name_;
};

}  // namespace gsv::rendering
