// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace redmap {

/// Calls `body(i)` for every i in [0, count), in any order, on up to `thread_count()` threads. `body` should not throw:
/// what can be checked is checked before. Where it must, as when a shader of the user's own fails on its device, the
/// loop is given up and the caller gets the exception, any one of them where there are several.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls `produce(i)` in parallel and then `consume(i)` one at a time in the order of i; at most a few per thread are
/// between the two at any moment, so memory stays bounded. `slot` in [0, pipeline_slots()) names the caller's scratch
/// space, exclusive from produce(i, slot) to the end of consume(i, slot).
void parallel_pipeline(std::size_t count, const std::function<void(std::size_t i, std::size_t slot)>& produce,
                       const std::function<void(std::size_t i, std::size_t slot)>& consume);
std::size_t pipeline_slots();

/// Threads in use: what was set, else one per core.
std::size_t thread_count();

/// While it lives, at most `threads` threads are used (0: one per core). Keep one, in main.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  Impl* impl_;
};

}  // namespace redmap
