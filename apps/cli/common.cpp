#include "common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_file.h"
#include "scene/scene_file.h"

namespace redmap::cli {

namespace {

std::atomic<bool> interrupt_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void request_interrupt(int) { interrupt_requested = true; }

std::string remaining_time(double seconds) {
  const long whole = static_cast<long>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

void add_common_options(CLI::App& sub, CommonOptions& options) {
  sub.add_option("--threads", options.threads, "threads to use; 0: one per core. Results are the same for any number")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  sub.add_flag("-v,--verbose", options.verbose, "say more");
  sub.add_option("--json", options.json, "also write the results here, for scripts")->type_name("FILE");
}

void add_override_option(CLI::App& sub, std::vector<std::string>& overrides) {
  sub.add_option("-D", overrides, "change the scene, for example -D ball.scale=20 or -D camera.width=1920; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_device_option(CLI::App& sub, std::string& device) {
  sub.add_option("--device", device,
                 "where shaders of your own run: the number of a device, or part of its name (redmap list devices)")
      ->type_name("DEVICE");
}

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), next_write_(start_) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  const std::scoped_lock lock(mutex_);
  if (written_) std::fputs("\r\033[K", stderr);
  written_ = false;
}

void Progress::update(double fraction) {
  if (!terminal_) return;
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  if (now < next_write_) return;
  next_write_ = now + std::chrono::milliseconds(100);
  written_ = true;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed_seconds = std::chrono::duration<double>(now - start_).count();
  // Under 1 % the guess of what remains would be noise.
  const std::string left =
      fraction > 0.01 ? remaining_time(elapsed_seconds * (1 - fraction) / fraction) + " left" : std::string();
  fmt::print(stderr, "\r\033[K{} {:3.0f} % {}", what_, 100 * fraction, left);
  std::fflush(stderr);
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = request_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_requested; }

const std::atomic<bool>& interrupt_flag() { return interrupt_requested; }

void stop_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

void print_remarks(const SceneFile& file, const CommonOptions& options) {
  for (const std::string& line : file.remarks()) fmt::print(stderr, "{}\n", line);
  if (!options.verbose) return;
  for (const std::string& line : file.assumptions()) fmt::print(stderr, "{}\n", line);
}

void write_json(const std::filesystem::path& path, const nlohmann::json& value) {
  if (path.empty()) return;
  // Names in old files may be in no encoding that JSON knows: their strange bytes become the replacement character.
  write_file(path, value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace redmap::cli
