// Which of the parameters of a scene's shaders is being changed, and to what.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace redmap::cli {

class ParameterEditor {
 public:
  explicit ParameterEditor(const Scene& scene);

  /// The next or the one before, over all objects.
  void select(int step);
  /// Larger or smaller by a step: an eighth of an octave where the range spans decades, else a twentieth of the range.
  void change(int step);

  struct Entry {
    std::size_t object;
    std::string object_name;
    ParameterInfo info;
    std::vector<float> value;
    bool changed = false;  ///< from what the scene file says
    bool is_baked = true;  ///< false since it was changed last, until settle()
  };
  /// Of all objects, in their order.
  const std::vector<Entry>& entries() const { return entries_; }
  /// Components stay in the parameter's range.
  void set(std::size_t entry, std::vector<float> value);

  /// Objects whose parameters were changed since settle().
  std::vector<std::size_t> unbaked_objects() const;
  void settle();
  /// "ball.scale = 14".
  std::string text() const;
  /// All that was changed, as SceneFile::load() takes it.
  std::vector<std::string> overrides() const;

 private:
  bool empty() const { return entries_.empty(); }

  std::vector<Entry> entries_;
  std::size_t selected_ = 0;
};

}  // namespace redmap::cli
