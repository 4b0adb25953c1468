#include "gsv/rendering/opengl/egl_context.h"

#include <gtest/gtest.h>

namespace gsv::rendering {
namespace {

TEST(EglDevices, AreListedIfMesaIsInstalled) {
  EXPECT_TRUE(
      ListsDevices("EGL_EXT_device_base EGL_EXT_device_enumeration EGL_EXT_device_query "
                   "EGL_EXT_platform_base EGL_EXT_client_extensions EGL_EXT_platform_device "
                   "EGL_EXT_platform_wayland EGL_MESA_platform_surfaceless"));
}

// Regression: with the extensions of NVIDIA's driver 580 through libglvnd, the card was not found.
TEST(EglDevices, AreListedIfNvidiasDriverIsTheOnlyOne) {
  EXPECT_TRUE(ListsDevices(
      "EGL_EXT_platform_base EGL_EXT_device_base EGL_KHR_client_get_all_proc_addresses "
      "EGL_EXT_client_extensions EGL_KHR_debug EGL_KHR_platform_x11 EGL_EXT_platform_x11 "
      "EGL_EXT_platform_device EGL_MESA_platform_surfaceless EGL_EXT_explicit_device"));
}

TEST(EglDevices, AreNotListedWithoutTheExtension) {
  EXPECT_FALSE(ListsDevices(nullptr));
  EXPECT_FALSE(ListsDevices(""));
  EXPECT_FALSE(ListsDevices("EGL_EXT_device_base EGL_MESA_platform_surfaceless"));
  EXPECT_FALSE(ListsDevices("EGL_EXT_platform_device EGL_EXT_device_enumeration"));
  EXPECT_FALSE(ListsDevices("EGL_EXT_platform_device EGL_EXT_device_base_2"));
}

}  // namespace
}  // namespace gsv::rendering
