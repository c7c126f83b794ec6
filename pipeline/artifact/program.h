// What every program of ours does about failures.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace hbr::inline artifact {

// A stage that did not do its work, though it was given the right things.
class StageFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Runs the body of a main: an InputError and an error of a file become one line on stderr and exit code 2, a
// StageFailure one line and exit code 1, any other exception one line and exit code 3 (with the limit where
// memory is out). `name` leads the line; the body may change it when it knows better. A file-size limit is an
// error to be read, not a signal to die from.
int guarded_main(const std::string& name, const std::function<int()>& body);

}  // namespace hbr::inline artifact
