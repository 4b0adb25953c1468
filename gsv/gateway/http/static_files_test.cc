#include "gsv/gateway/http/static_files.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "gsv/base/test_folder.h"

namespace gsv::gateway {
namespace {

namespace fs = std::filesystem;

class StaticFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Write("secret.txt", "secret");
    Write("web/index.html", "<p>viewer");
    Write("web/assets/app-1a2b.js", "let x;");
    Write("web/.hidden", "secret");
  }

  void Write(const std::string& name, const std::string& text) { folder_.Write(name, text); }

  Response Get(const std::string& target, const std::string& if_none_match = "") const {
    Request request;
    request.target = ParseTarget(target).value();
    request.if_none_match = if_none_match;
    return StaticFiles(place_ / "web").Get(request);
  }

  const base::testing::TestFolder folder_{};
  const fs::path place_ = folder_.path();
};

TEST_F(StaticFilesTest, ServesIndexHtmlAtTheRootAndChecksItEachTime) {
  const Response response = Get("/");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body.view(), "<p>viewer");
  EXPECT_EQ(response.content_type, "text/html; charset=utf-8");
  EXPECT_EQ(response.cache_control, "no-cache");
}

TEST_F(StaticFilesTest, AssetsAreCachedPermanently) {
  const Response response = Get("/assets/app-1a2b.js");
  EXPECT_EQ(response.body.view(), "let x;");
  EXPECT_EQ(response.content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(response.cache_control, "public, max-age=31536000, immutable");
}

TEST_F(StaticFilesTest, AnUnchangedFileIsNotSentAgain) {
  const std::string tag = Get("/").etag;
  ASSERT_FALSE(tag.empty());
  EXPECT_EQ(Get("/", tag).status, 304);
  EXPECT_EQ(Get("/", tag).body.size(), 0u);
  Write("web/index.html", "<p>another viewer");
  EXPECT_EQ(Get("/", tag).status, 200);
}

TEST_F(StaticFilesTest, NothingOutsideTheRootIsServed) {
  fs::create_symlink(place_ / "secret.txt", place_ / "web/link.txt");
  fs::create_directory_symlink(place_, place_ / "web/up");
  for (const char* target :
       {"/../secret.txt", "/..%2fsecret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt",
        "/assets/..%2f..%2fsecret.txt", "/..%5csecret.txt", "/link.txt", "/up/secret.txt",
        "/.hidden", "//etc/passwd", "/%2fetc%2fpasswd", "/index.html%00.js", "/assets",
        "/absent.js"}) {
    const Response response = Get(target);
    EXPECT_EQ(response.status, 404) << target;
    EXPECT_EQ(response.body.view().find("secret"), std::string_view::npos) << target;
  }
}

TEST_F(StaticFilesTest, ExplainsHowToInstallAMissingViewer) {
  Request request;
  request.target = ParseTarget("/").value();
  const Response response = StaticFiles(place_ / "a<b").Get(request);
  EXPECT_EQ(response.status, 404);
  EXPECT_EQ(response.content_type, "text/html; charset=utf-8");
  EXPECT_NE(response.body.view().find("npm run build"), std::string_view::npos);
  EXPECT_NE(response.body.view().find("a&lt;b"), std::string_view::npos);
}

class DocumentationTest : public ::testing::Test {
 protected:
  Response Get(const std::string& target) const {
    Request request;
    request.raw_target = target;
    request.target = ParseTarget(target).value();
    return Documentation(folder_.path() / "docs").Get(request);
  }

  const base::testing::TestFolder folder_{};
};

TEST_F(DocumentationTest, ServesThePagesOfItsFolder) {
  folder_.Write("docs/index.html", "<p>start");
  folder_.Write("docs/tutorial/02.html", "<p>wander");
  folder_.Write("secret.txt", "secret");
  EXPECT_EQ(Get("/docs/").body.view(), "<p>start");
  EXPECT_EQ(Get("/docs/?q=1").body.view(), "<p>start");
  EXPECT_EQ(Get("/docs/tutorial/02.html").body.view(), "<p>wander");
  EXPECT_EQ(Get("/docs/tutorial/02.html").cache_control, "no-cache");
  EXPECT_TRUE(Get("/docs/tutorial/02.html").allows_own_frames);
  EXPECT_EQ(Get("/docs/absent.html").status, 404);
  EXPECT_EQ(Get("/docs/..%2fsecret.txt").status, 404);
}

TEST_F(DocumentationTest, RedirectsToTheAddressWithASlash) {
  folder_.Write("docs/index.html", "<p>start");
  const Response response = Get("/docs");
  EXPECT_EQ(response.status, 200);
  EXPECT_NE(response.body.view().find("url=docs/"), std::string_view::npos);
}

TEST_F(DocumentationTest, ExplainsHowToBuildMissingDocumentation) {
  const Response response = Get("/docs/");
  EXPECT_EQ(response.status, 404);
  EXPECT_EQ(response.content_type, "text/html; charset=utf-8");
  EXPECT_NE(response.body.view().find("make docs"), std::string_view::npos);
}

TEST(ContentTypeOf, ReturnsTheTypesOfTheViewersFiles) {
  EXPECT_EQ(ContentTypeOf("a/b.PNG"), "image/png");
  EXPECT_EQ(ContentTypeOf("x.wasm"), "application/wasm");
  EXPECT_EQ(ContentTypeOf("x.glb"), "model/gltf-binary");
  EXPECT_EQ(ContentTypeOf("x"), "application/octet-stream");
}

}  // namespace
}  // namespace gsv::gateway
