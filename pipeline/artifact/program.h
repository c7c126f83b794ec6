// What every program of ours does about failures.
#pragma once

#include <functional>
#include <string>

namespace hbr {

// Runs the body of a main: an InputError and an error of a file become one line on stderr and exit code 2,
// any other exception one line and exit code 3 (with the limit where memory is out). `name` leads the line;
// the body may change it when it knows better. A file-size limit is an error to be read, not a signal to die
// from.
int guarded_main(const std::string& name, const std::function<int()>& body);

}  // namespace hbr
