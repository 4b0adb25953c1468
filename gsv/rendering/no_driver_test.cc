// This test is a program of its own, because EGL searches for its drivers only once per process.
#include <cstdlib>

#include <gtest/gtest.h>

#include "gsv/rendering/renderer.h"

namespace gsv::rendering {
namespace {

TEST(RendererWithoutADriver, ErrorNamesThePackageToInstall) {
  // GLVND reads the list of drivers from the file in this variable. The file does not exist.
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/driver.json", 1);
  RendererOptions options;
  options.back_end = BackEnd::kOpenGl;
  const auto started = Renderer::Start(options);
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(started.error().message.find("install libegl1"), std::string::npos);
}

TEST(RendererWithoutADriver, CanUseTheRasteriser) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/driver.json", 1);
  const auto started = Renderer::Start();
  ASSERT_TRUE(started) << started.error().Sentence();
  EXPECT_NE((*started)->renderer_name().find("rasteriser"), std::string::npos);
}

}  // namespace
}  // namespace gsv::rendering
