#include "interruptible.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace redmap::python {
namespace {

// Between two looks at signals: short beside what a person takes for at once, long beside a look.
constexpr std::chrono::milliseconds kPatience{50};

/// A thread's end, to be waited for.
class Ending {
 public:
  void announce() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return ended_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
};

/// Returns when `ending` has come. Throws what a signal or `progress` raises.
void watch(Ending& ending, const std::atomic<float>& part, const Progress& progress) {
  for (;;) {
    {
      const nb::gil_scoped_release release;
      if (ending.wait()) return;
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (progress) (*progress)(part.load());
  }
}

}  // namespace

void run_interruptibly(const std::function<void(Work&)>& body, const Progress& progress) {
  Work work;
  Ending ending;
  std::exception_ptr failure, raised;
  std::thread thread([&] {
    try {
      body(work);
    } catch (...) {
      failure = std::current_exception();
    }
    ending.announce();
  });
  try {
    watch(ending, work.part_, progress);
  } catch (...) {
    raised = std::current_exception();
    work.stopped_ = true;
  }
  {
    const nb::gil_scoped_release release;
    thread.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
  if (progress) (*progress)(1.0f);
}

}  // namespace redmap::python
