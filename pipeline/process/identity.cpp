#include "pipeline/process/identity.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace hbr::inline process {
namespace {

// By /proc: 0 where it has ended or is about to.
unsigned long long start_of(int id) {
  std::ifstream file(fmt::format("/proc/{}/stat", id));
  std::ostringstream content;
  content << file.rdbuf();  // which fails, and does not throw, where the process ends while it is read
  const std::string text = content.str();
  const std::size_t name = text.rfind(')');  // it may hold spaces itself
  if (name == std::string::npos) return 0;
  char state = 0;
  unsigned long long started = 0;
  const int found = std::sscanf(
      text.c_str() + name + 1,
      " %c %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %llu", &state, &started);
  return found == 2 && state != 'Z' && state != 'X' ? started : 0;
}

bool is_plain(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '.' || letter == '_';
}

template <class Number>
bool read_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string this_host() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  for (char& letter : name)
    if (letter && !is_plain(letter)) letter = '_';
  return name;
}

Process this_process() { return {this_host(), ::getpid(), start_of(::getpid())}; }

bool is_alive(const Process& process) {
  return process.started != 0 && start_of(process.id) == process.started;
}

void ask_to_end(const Process& process) {
  if (is_alive(process)) ::kill(process.id, SIGTERM);
}

std::string text_of(const Process& process) {
  return fmt::format("{}.{}@{}", process.id, process.started, process.host);
}

std::optional<Process> process_of(std::string_view text) {
  const std::size_t dot = text.find('.'), at = text.find('@');
  Process process;
  if (dot == std::string_view::npos || at == std::string_view::npos || at < dot ||
      !read_number(text.substr(0, dot), process.id) ||
      !read_number(text.substr(dot + 1, at - dot - 1), process.started))
    return {};
  process.host = text.substr(at + 1);
  if (process.host.empty() || !std::ranges::all_of(process.host, is_plain)) return {};
  return process;
}

}  // namespace hbr::inline process
