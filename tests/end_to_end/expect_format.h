// FORMAT.md against the files of a run: what is there is described, what is described is there.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"

namespace hbr {

class DescribedFormat {
 public:
  DescribedFormat() {
    std::ifstream file(HBR_SOURCE_DIR "/pipeline/artifact/FORMAT.md");
    std::string paragraph;
    for (std::string line; std::getline(file, line);) {
      const bool heading = line.starts_with("## ");
      if (line.empty() || heading) close(paragraph);
      if (heading) section_ = line;
      if (!line.empty() && !heading) paragraph += line + "\n";
    }
    close(paragraph);
  }

  void expect(const std::filesystem::path& out) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
      if (entry.path().extension() != ".h5") continue;
      const std::string name = entry.path().lexically_relative(out).string();
      const std::string text = description(name);
      const Hdf5Reader file(entry.path());
      for (const std::string& array : arrays(file, "/"))
        EXPECT_TRUE(is_told(text, array)) << name << ": " << array << " stands nowhere in FORMAT.md";
    }
    const std::regex name("`([A-Za-z0-9_/]+\\.h5)`");
    for (const std::string& paragraph : paragraphs_)
      for (std::sregex_iterator match(paragraph.begin(), paragraph.end(), name), end; match != end; ++match) {
        const std::string told = (*match)[1];
        if (told == "descriptor.h5" || told.starts_with("VARIATION/") || told == "NAME/RR.h5") continue;
        EXPECT_TRUE(std::ranges::any_of(seen_,
                                        [&](const std::string& pattern) {
                                          return pattern == told || (told == "layer1_search_A/RR.h5" &&
                                                                     pattern.starts_with("layer1_search_"));
                                        }))
            << told << " is described, and not made";
      }
  }

 private:
  void close(std::string& paragraph) {
    if (section_ == "## Repertoires") repertoires_ += paragraph;
    if (!paragraph.empty()) paragraphs_.push_back(paragraph);
    paragraph.clear();
  }

  // "nao_left_tuned/00.h5" -> "ROBOT_tuned/RR.h5"; the paragraph that begins with it, and that of all
  // repertoires where it is one.
  std::string description(const std::string& name) {
    std::string pattern = std::regex_replace(name, std::regex("/[0-9]+\\.h5$"), "/RR.h5");
    seen_.insert(pattern);
    pattern = std::regex_replace(pattern, std::regex("^(nao_left|nao|industrial|arm)_"), "ROBOT_");
    seen_.insert(pattern);
    for (const std::string& paragraph : paragraphs_)
      if (paragraph.starts_with("`" + pattern + "`"))
        return paragraph.find("repertoire") != std::string::npos ? paragraph + repertoires_ : paragraph;
    return repertoires_;
  }

  static std::vector<std::string> arrays(const Hdf5Reader& file, const std::string& group) {
    std::vector<std::string> all;
    for (const std::string& child : file.children(group)) {
      const std::string path = group == "/" ? child : group + "/" + child;
      try {
        const std::vector<std::string> inner = arrays(file, path);
        all.insert(all.end(), inner.begin(), inner.end());
      } catch (const InputError&) {  // no group
        all.push_back(path);
      }
    }
    return all;
  }

  // `array`, or its last word after another array's as in `/mean`, or its group as in `weights/...`.
  static bool is_told(const std::string& text, const std::string& array) {
    const std::string last = array.substr(array.rfind('/') + 1), group = array.substr(0, array.find('/'));
    return text.find("`" + last + "`") != std::string::npos ||
           text.find("/" + last + "`") != std::string::npos ||
           text.find("`" + group + "/...`") != std::string::npos;
  }

  std::string section_, repertoires_;
  std::vector<std::string> paragraphs_;
  std::set<std::string> seen_;
};

}  // namespace hbr
