// What a file or folder holds, as SHA-256, and a cheap fingerprint: whether it may have changed since.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace hbr::inline artifact {

std::string sha256_of_text(std::string_view text);  // 64 hexadecimal digits

struct Content {
  std::string sha256;  // of the file; of a folder: of the sorted list of its files and their hashes
  std::map<std::string, std::string> files;  // of a folder: path below it -> sha256
  std::uint64_t bytes = 0;                   // of all files
};

// Throws InputError where the path, or something in the folder, is missing, can't be read or is neither a
// file nor a folder.
Content content_of(const std::filesystem::path& path);

// The hash of what a program executes: an ELF file's loaded segments, so that debug information does not
// matter; the whole file where it is a script.
std::string sha256_of_program(const std::filesystem::path& path);

// Sizes, times and inodes of the file, or of all files of the folder: whatever writes to one changes this.
// Empty where the path is missing.
std::string fingerprint(const std::filesystem::path& path);

// Writes the file or all of the folder's files through to the disk.
void sync_to_disk(const std::filesystem::path& path);

// A whole file. Throws InputError where it is missing, can't be read or is no file.
std::string read_whole(const std::filesystem::path& path);

// Writes a new file, or over an old one, without a care for a machine that stops. Throws InputError.
void write_file(const std::filesystem::path& path, std::string_view text);

// Replaces the file as a whole: a reader, or a machine that stops, finds the old or the new text.
void write_whole(const std::filesystem::path& path, std::string_view text);

}  // namespace hbr::inline artifact
