// A temporary folder with a profile of the fake experiment, and the tool called on it as from a shell.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "pipeline/core/settings.h"
#include "tests/end_to_end/fake_experiment.h"
#include "tests/support/shell.h"

namespace hbr {

class FakeFolder {
 public:
  explicit FakeFolder(const std::string& name)
      : path(std::filesystem::temp_directory_path() / ("hbr_" + std::to_string(::getpid()) + "_" + name)) {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    profile.replications = 2;
    profile.base.number = 1;
    profile.layer_a.number = 2;
    profile.layer_b.number = 3;
    profile.sum.number = 4;
  }
  ~FakeFolder() { std::filesystem::remove_all(path); }

  std::filesystem::path out() const { return path / "out"; }
  std::string tool() const { return (programs / "fake_tool").string(); }

  // Writes the profile and gives the words that call the tool on it.
  std::string command(const std::string& subcommand, const std::string& rest = "") const {
    return command_at(out(), subcommand, rest);
  }
  std::string command_at(const std::filesystem::path& folder, const std::string& subcommand,
                         const std::string& rest = "") const {
    write_profile();
    return tool() + " " + subcommand + " --profile " + (path / "profile.toml").string() + " --out " +
           folder.string() + " " + rest;
  }
  ShellResult make(const std::string& rest = "") const { return shell(command("make", rest)); }
  ShellResult status() const { return shell(command("status")); }

  // The bytes of all artifacts, without what tells of the run: manifests and the plan.
  static std::map<std::string, std::string> artifacts(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().lexically_relative(folder).string();
      if (!entry.is_regular_file() || name.starts_with(".plan") || name.ends_with(".json")) continue;
      std::ifstream stream(entry.path(), std::ios::binary);
      all[name] = std::string(std::istreambuf_iterator<char>(stream), {});
    }
    return all;
  }
  std::map<std::string, std::string> artifacts() const { return artifacts(out()); }

  std::filesystem::path path, programs = std::string(HBR_BINARY_DIR) + "/fake";
  FakeProfile profile;

 private:
  void write_profile() const {
    std::ofstream file(path / "profile.toml");
    const auto table = [&](const char* name, const FakeSettings& s) {
      file << "[" << name << "]\nnumber = " << s.number << "\nsteps = " << s.steps << "\nsize = " << s.size
           << "\nbehaviour = \"" << s.behaviour << "\"\n";
    };
    file << "replications = " << profile.replications << "\nsources = [";
    for (const std::string& source : profile.sources) file << "\"" << source << "\", ";
    file << "]\n";
    table("base", profile.base);
    table("layer_a", profile.layer_a);
    table("layer_b", profile.layer_b);
    table("sum", profile.sum);
  }
};

// The names that "NAME: made in ..." lines tell, sorted and joined.
inline std::string made(const ShellResult& outcome) {
  std::map<std::string, int> names;
  for (std::size_t at = 0; (at = outcome.text.find(": made in ", at)) != std::string::npos; ++at) {
    const std::size_t line = outcome.text.rfind('\n', at) + 1;  // npos + 1 is 0
    ++names[outcome.text.substr(line, at - line)];
  }
  std::string all;
  for (const auto& [name, count] : names) {
    if (!all.empty()) all += " ";
    all += name;
  }
  return all;
}

}  // namespace hbr
