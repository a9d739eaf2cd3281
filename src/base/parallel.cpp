#include "base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <utility>
#include <vector>

namespace redmap {

namespace tbb = oneapi::tbb;

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

std::size_t pipeline_slots() { return 4 * thread_count(); }

void parallel_pipeline(std::size_t count, const std::function<void(std::size_t, std::size_t)>& produce,
                       const std::function<void(std::size_t, std::size_t)>& consume) {
  using Item = std::pair<std::size_t, std::size_t>;
  const std::size_t slots = pipeline_slots();
  std::size_t next = 0;
  // Tokens are handed out and given back in order, so item i may reuse the slot of item i - slots.
  const auto source = tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    const std::size_t i = next < count ? next++ : next;
    return Item{i, i % slots};
  });
  const auto work = tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, [&](Item item) {
    produce(item.first, item.second);
    return item;
  });
  const auto sink = tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order,
                                                 [&](Item item) { consume(item.first, item.second); });
  tbb::parallel_pipeline(slots, source & work & sink);
}

std::size_t thread_count() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); }

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t threads)
    : impl_(threads == 0 ? nullptr : new Impl{{tbb::global_control::max_allowed_parallelism, threads}}) {}

ThreadLimit::~ThreadLimit() { delete impl_; }

}  // namespace redmap
