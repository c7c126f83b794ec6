// The real experiment, tiny: a profile with small numbers, a dataset made for it, the tool called as from a
// shell.
#pragma once

#include <fmt/format.h>

#include <regex>

#include "tests/end_to_end/fake_folder.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/dataset/idx_fixture.h"
#include "tests/support/temporary_folder.h"

namespace hbr {

namespace fs = std::filesystem;

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The paper's profile with other numbers.
class TinyProfile {
 public:
  TinyProfile() : text_(read(std::string(HBR_SOURCE_DIR) + "/stages/profiles/paper.toml")) {}

  // The first such key after the header of a table; "" is the head of the file.
  void set(const std::string& table, const std::string& key, const std::string& value) {
    const std::size_t from = table.empty() ? 0 : text_.find("[" + table + "]");
    std::smatch found;
    if (from == std::string::npos || !std::regex_search(text_.cbegin() + static_cast<std::ptrdiff_t>(from),
                                                        text_.cend(), found, assignment(key)))
      throw std::runtime_error(fmt::format("the profile has no {} {}", table, key));
    text_.replace(from + static_cast<std::size_t>(found.position()), static_cast<std::size_t>(found.length()),
                  fmt::format("\n{} = {}", key, value));
  }
  void set_everywhere(const std::string& key, const std::string& value) {
    text_ = std::regex_replace(text_, assignment(key), fmt::format("\n{} = {}", key, value));
  }
  // Takes away the robot of this name, which is not the last one.
  void without_robot(const std::string& robot) {
    const std::string header = "[[robots]]\n";
    const std::size_t from = text_.find(header + "name = \"" + robot + "\""),
                      next = from == std::string::npos ? from : text_.find(header, from + 1);
    if (next == std::string::npos)
      throw std::runtime_error("the profile has no robot " + robot + " before others");
    text_.erase(from, next - from);
  }
  void write(const fs::path& path) const { std::ofstream(path) << text_; }

 private:
  static std::regex assignment(const std::string& key) {
    return std::regex(fmt::format("\n{} = (\\[[^\\]]*\\]|[^\n]*)", key));
  }
  std::string text_;
};

class TinyExperiment {
 public:
  TinyExperiment() {
    write_images("train", 200);
    write_images("t10k", 100);
    profile.set("", "name", "\"tiny\"");
    profile.set("replications", "lines", "1");
    profile.set("replications", "digits", "1");
    profile.set("dataset", "name", "\"strokes\"");
    profile.set("dataset", "folder", fmt::format("\"{}\"", folder_.path().string()));
    profile.set("dataset", "sha256", "[]");
    profile.set("autoencoder", "epochs", "6");
    profile.set("autoencoder", "batch", "10");
    profile.set("autoencoder", "learning_rate", "1e-4");  // more would press all images into a corner
    profile.set("judge", "training_images", "200");
    profile.set("judge", "bumps", "50");
    profile.set("random_strokes", "images", "50");
    profile.set("defaults", "batch", "50");
    profile.set("defaults", "record_every", "10");
    profile.set("defaults", "cvt_cells", "200");
    profile.set("searches", "replications", "2");
    profile.set("accuracy", "requests", "200");
    profile.set("arc_quality", "fresh_starts", "20");
    profile.set("dynamics", "every", "100");
    for (const char* layer : {"line", "arc", "digit"})
      profile.set("tuning", fmt::format("{}_generations", layer), "5");
    profile.set("robot_picture", "height", "150");
    profile.set("robot_shape", "triangles", "3000");
    profile.set_everywhere("generations", "20");
    profile.set_everywhere("samples", "3");
    profile.set("robot_layer1", "generations", "200");  // few random configurations come near a plane
    profile.set("robot_plane", "samples", "5000");
    profile.set("robot_plane", "refined", "1");
    profile.without_robot("nao_left");  // as good as the other arm's, and as long to look for a plane
  }

  fs::path out(const std::string& name) const { return folder_.path() / name; }
  ShellResult make(const std::string& name, int threads) const {
    profile.write(folder_.path() / "profile.toml");
    return make_of("profile.toml", name, threads);
  }
  // Of a profile that stands beside it.
  ShellResult make_of(const std::string& profile_file, const std::string& name, int threads,
                      const std::string& goals = "") const {
    return shell("cd " HBR_SOURCE_DIR " && " HBR_BINARY_DIR "/bin/hbr make --profile " +
                 (folder_.path() / profile_file).string() + " --out " + out(name).string() + " --threads " +
                 std::to_string(threads) + " " + goals);
  }

  // The bytes of all artifacts, without the plan and the manifests beside them.
  std::map<std::string, std::string> artifacts(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(out(name))) {
      const fs::path path = entry.path(), below = path.lexically_relative(out(name));
      fs::path described = path;
      described.replace_extension();
      const bool manifest =
          path.extension() == ".json" && (fs::exists(described) || fs::exists(described.string() + ".h5"));
      if (entry.is_regular_file() && *below.begin() != ".plan" && !manifest) all[below.string()] = read(path);
    }
    return all;
  }

  TinyProfile profile;

 private:
  void write_images(const std::string& half, int n) const {
    const auto write = [&](const std::string& name, const Bytes& bytes) {
      std::ofstream(folder_.path() / (half + name), std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    const auto count = static_cast<std::uint32_t>(n);
    Bytes labels;
    for (int i = 0; i < n; ++i) labels.push_back(static_cast<std::uint8_t>(i % 10));
    write("-images-idx3-ubyte", idx_bytes({count, 28, 28}, stroke_images(n, Seed(1).child(half))));
    write("-labels-idx1-ubyte", idx_bytes({count}, labels));
  }
  TemporaryFolder folder_;
};

}  // namespace hbr
