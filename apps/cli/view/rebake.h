// A scene with other parameters, and its map, made while the old one is still shown.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "map/reduction_map.h"
#include "scene/scene_file.h"

namespace redmap::cli {

struct RebakedScene {
  SceneFile file;
  struct Map {
    std::size_t object = 0;
    std::shared_ptr<const ReductionMap> map;
  };
  std::vector<Map> maps;  ///< of the objects asked for
};

/// One at a time: what is asked for last counts.
class Rebake {
 public:
  ~Rebake() { stop(); }
  /// An object, and the size of its map.
  struct Wanted {
    std::size_t object;
    int size;
  };
  /// Loads the scene with `overrides` and bakes objects.
  void start(const std::string& scene, const std::vector<std::string>& overrides, const std::string& device,
             const std::vector<Wanted>& objects);
  bool is_running() const { return thread_.joinable() && !done_; }
  /// What was asked for, once it is there. Throws Error where it failed.
  std::optional<RebakedScene> take();

 private:
  void stop();

  std::thread thread_;
  std::atomic<bool> done_ = false, cancelled_ = false;
  std::optional<RebakedScene> result_;  ///< of the thread, until done_
  std::string error_;
};

}  // namespace redmap::cli
