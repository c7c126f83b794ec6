// A reader of foreign files under libFuzzer: each .cpp of this folder but main.cpp says what good files look
// like and how a program reads one; main.cpp does the rest.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hbr::fuzz {

// Good files, from which libFuzzer makes others.
std::vector<std::string> examples();

// Reads a file of these bytes as a program would. May throw InputError; whatever else leaves it is a finding.
void read(const std::string& bytes);

// Part of a reading: where it throws InputError the parts after it are read all the same.
void and_go_on(const std::function<void()>& part);

// A folder of this process's own, and a file in it.
const std::filesystem::path& folder();
std::filesystem::path written(const std::string& name, const std::string& bytes);
std::string content_of_file(const std::filesystem::path& path);

}  // namespace hbr::fuzz
