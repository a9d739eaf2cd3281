// Long work that Python can watch and stop: it runs on a thread of its own without the interpreter's lock, while the
// thread that called looks after Ctrl-C and progress.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "bindings.h"

namespace redmap::python {

/// Python's: told the part that is done, 0 to 1.
using Progress = std::optional<nb::typed<nb::callable, void(float)>>;

/// What work is given. Both calls are for any thread.
class Work {
 public:
  void tell(double part) { part_ = static_cast<float>(part); }
  bool stopped() const { return stopped_; }

 private:
  friend void run_interruptibly(const std::function<void(Work&)>& body, const Progress& progress);
  std::atomic<float> part_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// Runs `body`, and throws what it throws. What a signal or `progress` raises stops it, and is thrown once it has
/// ended.
void run_interruptibly(const std::function<void(Work&)>& body, const Progress& progress);

}  // namespace redmap::python
