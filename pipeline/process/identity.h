// A process among all hosts that share a folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hbr::inline process {

std::string this_host();

// Known by its number and its start, so that it is not taken for a later one of the same number.
struct Process {
  std::string host;
  int id = 0;
  unsigned long long started = 0;  // clock ticks after the host's start

  bool operator==(const Process&) const = default;
};

Process this_process();
// Only of this host's: whether it has not ended, and a termination signal for it.
bool is_alive(const Process& process);
void ask_to_end(const Process& process);

// "1234.56789@host", as file names carry it; the host's odd characters become '_'.
std::string text_of(const Process& process);
std::optional<Process> process_of(std::string_view text);

}  // namespace hbr::inline process
