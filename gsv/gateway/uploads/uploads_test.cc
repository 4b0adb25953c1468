#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/testing/server_fixture.h"
#include "gsv/gateway/testing/web_client.h"
#include "gsv/gateway/uploads/uploads_api.h"

namespace gsv::gateway::uploads {
namespace {

namespace fs = std::filesystem;

std::string ContentOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(UploadFolder, KeepsRelativePathsAndRemovesFilesAtItsEnd) {
  fs::path world;
  {
    UploadFolder folder;
    const std::string set = folder.Begin().value();
    world = folder.Put(set, {"a world.sdf"}, "<sdf/>").value();
    const fs::path mesh = folder.Put(set, {"meshes", "cube.stl"}, "solid").value();
    EXPECT_EQ(ContentOf(world), "<sdf/>");
    EXPECT_EQ(mesh, world.parent_path() / "meshes" / "cube.stl");
    EXPECT_NE(folder.Begin().value(), set);
    EXPECT_EQ(ContentOf(folder.Put(set, {"a world.sdf"}, "again").value()), "again");
  }
  EXPECT_FALSE(fs::exists(world));
}

TEST(UploadFolder, RefusesNamesOutsideTheFolder) {
  UploadFolder folder;
  const std::string set = folder.Begin().value();
  const std::vector<std::vector<std::string>> bad{{},
                                                  {""},
                                                  {".."},
                                                  {"a", "..", "b"},
                                                  {"/etc/x"},
                                                  {"a/../../b"},
                                                  {".hidden"},
                                                  {"a\\b"},
                                                  {std::string("a\0b", 3)},
                                                  {"a\nb"},
                                                  {std::string(201, 'a')},
                                                  std::vector<std::string>(13, "a")};
  for (const auto& path : bad) {
    const auto put = folder.Put(set, path, "x");
    ASSERT_FALSE(put);
    EXPECT_EQ(put.error().code, base::ErrorCode::kInvalidArgument);
  }
  for (const char* other : {"", "0", "2", "-1", "..", "1/..", "x"}) {
    EXPECT_EQ(folder.Put(other, {"a"}, "x").error().code, base::ErrorCode::kNotFound) << other;
  }
}

TEST(UploadFolder, EnforcesItsLimits) {
  UploadFolder folder({.files = 2, .bytes = 10});
  const std::string set = folder.Begin().value();
  EXPECT_EQ(folder.Put(set, {"a"}, "12345678901").error().code, base::ErrorCode::kUnavailable);
  EXPECT_TRUE(folder.Put(set, {"a"}, "1234567890"));
  EXPECT_FALSE(folder.Put(set, {"b"}, "1"));
  EXPECT_TRUE(folder.Put(set, {"b"}, ""));
  EXPECT_FALSE(folder.Put(set, {"c"}, ""));
}

class UploadsTest : public testing::ServerTest {};

TEST_F(UploadsTest, TwoGigabytesAreRefusedBeforeTheyAreSent) {
  Start();
  testing::HttpConnection connection(port());
  connection.Send("PUT /api/uploads/1/big.sdf HTTP/1.1\r\nHost: 127.0.0.1:" +
                  std::to_string(port()) + "\r\nContent-Length: 2147483648\r\n\r\n");
  const auto answer = connection.Receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 413);
  EXPECT_NE(answer->body.find("67108864 bytes"), std::string::npos);
}

TEST_F(UploadsTest, AMegabyteIsAcceptedForUploadsOnly) {
  Start();
  const std::string megabyte(1 << 20, 'x');
  const auto taken = testing::Fetch(port(), "PUT", "/api/uploads/1/a.sdf", "", megabyte);
  EXPECT_EQ(taken.status, 200);
  EXPECT_EQ(taken.body.size(), megabyte.size() + std::string("PUT /api/uploads/1/a.sdf ").size());
  EXPECT_EQ(testing::Fetch(port(), "PUT", "/api/simulations", "", megabyte).status, 413);
}

TEST_F(UploadsTest, AClientWithoutPermissionIsRefusedBeforeTheFileIsSent) {
  ServerOptions options;
  options.tokens.control = "a-token-that-nobody-guesses";
  Start(options);
  testing::HttpConnection connection(port());
  connection.Send("PUT /api/uploads/1/big.sdf HTTP/1.1\r\nHost: 127.0.0.1:" +
                  std::to_string(port()) + "\r\nContent-Length: 1000000\r\n\r\n");
  EXPECT_EQ(connection.Receive()->status, 401);
}

}  // namespace
}  // namespace gsv::gateway::uploads
