#include "gsv/orb/local_socket.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::orb {
namespace {

namespace fs = std::filesystem;

class LocalSocket : public ::testing::Test {
 protected:
  void SetUp() override { PutInto(folder_.path()); }
  static void PutInto(const fs::path& folder) { setenv("XDG_RUNTIME_DIR", folder.c_str(), 1); }
  fs::path folder() const { return folder_.path() / "gsv"; }

 private:
  base::TemporaryFolder folder_ = *base::TemporaryFolder::Make("local-socket");
};

TEST_F(LocalSocket, IsInAFolderOfThisUserOnly) {
  const auto socket = NewLocalSocket();
  ASSERT_TRUE(socket.has_value()) << socket.error().Sentence();
  EXPECT_EQ(socket->parent_path(), folder());
  EXPECT_EQ(fs::status(folder()).permissions(), fs::perms::owner_all);
  EXPECT_NE(*socket, *NewLocalSocket());
}

TEST_F(LocalSocket, RemovesSocketsOfEndedProcessesOnly) {
  fs::create_directory(folder());
  fs::permissions(folder(), fs::perms::owner_all);
  // The file of a process that has ended: no process has a number above 2^22, see proc(5).
  const fs::path left = folder() / "99999999-0000abcd.socket";
  const fs::path used = folder() / (std::to_string(getpid()) + "-0000abcd.socket");
  const fs::path other = folder() / "99999999.json";
  for (const fs::path& each : {left, used, other}) std::ofstream(each) << "";
  ASSERT_TRUE(NewLocalSocket().has_value());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(used));
  EXPECT_TRUE(fs::exists(other));
}

TEST_F(LocalSocket, IsRefusedInAWritableFolderOrForALongName) {
  fs::create_directory(folder());
  fs::permissions(folder(), fs::perms::all);
  EXPECT_FALSE(NewLocalSocket().has_value());
  fs::permissions(folder(), fs::perms::owner_all);
  const fs::path deep = folder() / std::string(100, 'x');
  fs::create_directory(deep);
  PutInto(deep);
  EXPECT_FALSE(NewLocalSocket().has_value());
}

}  // namespace
}  // namespace gsv::orb
