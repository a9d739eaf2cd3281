// What every subcommand shares: common flags, progress on the terminal, interruption, JSON results.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace redmap {
class SceneFile;
}

namespace redmap::cli {

struct CommonOptions {
  int threads = 0;  ///< 0: one per core; commands keep a ThreadLimit of it while they run
  bool verbose = false;
  std::string json;  ///< where machine-readable results go; empty: nowhere
};

/// Declares --threads, -v/--verbose and --json on `sub`, bound to `options`, which must outlive the parse.
void add_common_options(CLI::App& sub, CommonOptions& options);

/// Declares -D on `sub`, which changes the scene before it is read (scene/scene_file.h); may be given several times,
/// and takes one argument each time, so that the scene's own name can follow.
void add_override_option(CLI::App& sub, std::vector<std::string>& overrides);

/// Declares --device: where shaders of the user's own run.
void add_device_option(CLI::App& sub, std::string& device);

/// One line on stderr, "what 42 % 1:03 left", only when stderr is a terminal, and cleared when it is destroyed.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Part done, 0 to 1. From any thread, as often as you like: at most 10 lines a second are written.
  void update(double fraction);
  /// Takes the line away, for others to be printed; the next update() brings it back.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  const std::string what_;
  const bool terminal_;
  const Clock::time_point start_;
  std::mutex mutex_;
  Clock::time_point next_write_;
  bool written_ = false;
};

/// Thrown to unwind after an interrupt; main prints "interrupted" and exits with 130.
struct Interrupted {};

/// From here on SIGINT and SIGTERM set a flag; a second one ends the program at once.
void catch_interrupts();
/// Whether to stop: long work polls it, from any thread, and unwinds leaving nothing half-written.
bool interrupted();
/// The same flag, for library calls that take one.
const std::atomic<bool>& interrupt_flag();
/// Throws Interrupted if the flag is set.
void stop_if_interrupted();

/// Says on stderr what was wrong with a scene's meshes, and with -v what was taken for granted about them.
void print_remarks(const SceneFile& file, const CommonOptions& options);

/// Writes `value`, indented, through a temporary name. Does nothing for an empty path. Throws Error.
void write_json(const std::filesystem::path& path, const nlohmann::json& value);

}  // namespace redmap::cli
